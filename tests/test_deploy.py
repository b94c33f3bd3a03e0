"""Deployment files: their commands and settings exist, and the tools that read them accept them."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from app import config
from app.cli.main import parser
from app.config import VARIABLES, Settings, from_environment

ROOT = Path(__file__).parent.parent
DEPLOY = ROOT / "docs" / "deploy"
UNITS = sorted(DEPLOY.glob("*.service"))
OTHER = frozenset({"RTHS_CACHE", "RTHS_WEB", "RTHS_SITE", "RTHS_HOME", "RTHS_ENVIRONMENT"})  # of scripts and compiler
KNOWN = {one.key for one in VARIABLES.values()} | OTHER
FOLDERS = {
    "StateDirectory": "/var/lib",
    "CacheDirectory": "/var/cache",
    "RuntimeDirectory": "/run",
    "LogsDirectory": "/var/log",
}


@pytest.fixture(scope="module")
def compose() -> dict[str, Any]:
    found: dict[str, Any] = YAML(typ="safe").load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
    return found


def test_every_service_waits_for_what_is_declared_and_healthy(compose: dict[str, Any]) -> None:
    services = compose["services"]
    assert {"database", "web-1", "web-2", "worker", "proxy"} <= services.keys()
    for name, one in services.items():
        assert one["restart"] == "unless-stopped" and "healthcheck" in one, name
        for other, how in one.get("depends_on", {}).items():
            assert how["condition"] == "service_healthy" and "test" in services[other]["healthcheck"], name
        assert set(one.get("secrets", [])) <= compose["secrets"].keys(), name
        volumes = {volume.partition(":")[0] for volume in one["volumes"]} if "volumes" in one else set()
        assert all(volume in compose["volumes"] or (ROOT / volume).is_file() for volume in volumes), name


def test_the_commands_of_the_containers_are_commands_of_rths(compose: dict[str, Any]) -> None:
    for name in ("web-1", "web-2", "worker"):
        program, *arguments = compose["services"][name]["command"]
        assert program == ".venv/bin/rths" and parser().parse_args(arguments).command in ("serve", "worker")
    (web,) = [one for one in compose["services"]["worker"]["command"] if one.startswith("ws://")]
    assert [one.removeprefix("ws://").partition(":")[0] for one in web.split(",")] == ["web-1", "web-2"]


def test_every_volume_of_a_container_belongs_to_the_user_who_writes_it(compose: dict[str, Any]) -> None:
    """Docker gives a new volume the owner of the folder in the image; without that folder it is root's."""
    (made,) = re.findall(r"chown -R rths (.*)$", (ROOT / "Dockerfile").read_text(encoding="utf-8"), re.MULTILINE)
    for name in ("web-1", "web-2", "worker"):
        one = compose["services"][name]
        written = [volume.split(":")[1] for volume in one["volumes"]] + [one["environment"]["RTHS_DATA"]]
        assert "/store" in written and set(written) <= set(made.split()), name


def test_no_secret_stands_in_the_environment_of_a_container(compose: dict[str, Any]) -> None:
    for one in compose["services"].values():
        for name, value in one.get("environment", {}).items():
            if "TOKEN" in name or "PASSWORD" in name or name.endswith(("DATABASE_URL", "CREDENTIALS_FILE")):
                assert str(value).startswith("/run/secrets/"), name


@pytest.mark.parametrize("path", [ROOT / "compose.yaml", *sorted(DEPLOY.iterdir())], ids=lambda path: path.name)
def test_every_variable_in_a_deployment_file_is_one_of_the_program(path: Path) -> None:
    named = {one.removesuffix("_FILE") for one in re.findall(r"\bRTHS_[A-Z_]+", path.read_text(encoding="utf-8"))}
    assert named <= KNOWN, named - KNOWN


@pytest.mark.parametrize("path", UNITS, ids=lambda path: path.name)
def test_a_unit_is_accepted_by_systemd_and_starts_a_command_of_rths(path: Path, tmp_path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    (started,) = re.findall(r"^ExecStart=/opt/rths/\.venv/bin/rths (.*)$", text, re.MULTILINE)
    assert parser().parse_args(started.split()).command in ("serve", "worker")
    if shutil.which("systemd-analyze") is None:
        pytest.skip("systemd-analyze is not installed (on Debian: apt-get install systemd)")
    program = tmp_path / "rths"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    unit = tmp_path / path.name
    unit.write_text(text.replace("/opt/rths/.venv/bin/rths", str(program)))
    found = subprocess.run(["systemd-analyze", "verify", "--man=no", unit], capture_output=True, text=True, check=False)
    about = [line for line in found.stderr.splitlines() if path.stem.rstrip("@") in line]
    assert about == [], found.stderr


def lines(path: Path) -> list[tuple[str, str]]:
    """Keys and values of a unit or a file of variables, those of the first instance of a template."""
    found = (line.partition("=") for line in path.read_text(encoding="utf-8").replace("%i", "1").splitlines())
    return [(key, value) for key, sign, value in found if sign and not key.startswith("#")]


def in_force(unit: Path) -> dict[str, str]:
    """The variables of a unit: those of its file precede its own, as in systemd.exec(5)."""
    own = dict(value.split("=", 1) for key, value in lines(unit) if key == "Environment")
    assert ("EnvironmentFile", "/etc/rths/environment") in lines(unit)
    return {**own, **dict(lines(DEPLOY / "environment"))}


@pytest.mark.parametrize("unit", UNITS, ids=lambda path: path.name)
def test_a_unit_may_write_every_folder_that_its_settings_name(unit: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = lines(unit)
    assert ("ProtectSystem", "strict") in found and ("PrivateTmp", "true") in found
    writable = [Path(FOLDERS[key], name) for key, value in found if key in FOLDERS for name in value.split()]
    writable += [Path(path) for key, value in found if key == "ReadWritePaths" for path in value.split()]
    for name, value in (given := in_force(unit)).items():
        if not name.endswith("_FILE"):  # a secret, which is not here
            monkeypatch.setenv(name, value)
    settings = from_environment()
    store = Path(settings.store.removeprefix("file://"))
    for path in (settings.data, Path(given["RTHS_CACHE"]), store):
        assert path.is_absolute() and any(path.is_relative_to(one) for one in writable), path
        assert not path.is_relative_to("/tmp") and not path.is_relative_to("/var/tmp"), path  # which PrivateTmp empties
    assert ("RequiresMountsFor", str(store)) in found and ("UMask", "0077") in found


def test_the_units_answer_https_where_their_workers_ask_for_it() -> None:
    web, worker = (in_force(DEPLOY / name) for name in ("rths-web.service", "rths-worker@.service"))
    certificate = {"RTHS_TLS_CERTIFICATE", "RTHS_TLS_KEY"} <= web.keys()
    addresses = worker["RTHS_WEB"].split(",")
    assert {one.partition(":")[0] for one in addresses} == ({"wss"} if certificate else {"ws"})
    assert addresses[0].removeprefix("wss://").partition(":")[0] in web["RTHS_HOSTS"].split(",")
    paths = [value for found in (web, worker) for value in found.values() if value.startswith("/")]
    assert not [path for path in paths if path.startswith(("/home", "/root", "/run/user"))]  # which ProtectHome hides


def test_a_container_and_each_web_service_answer_by_address_and_by_the_name_that_others_use(
    compose: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(config, "own_names", lambda: frozenset({"4f1c2a"}))  # Docker's name of a container
    dockerfile = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    assert "RTHS_HOST=0.0.0.0" in dockerfile and "RTHS_HOSTS" not in dockerfile
    alone = Settings(host="0.0.0.0")
    assert alone.by_any_address and "localhost" in alone.known_hosts
    for name in ("web-1", "web-2"):
        given = compose["services"][name]["environment"]["RTHS_HOSTS"]
        hosts = given.removeprefix("${RTHS_HOSTS:-").removesuffix("}").split(",")
        known = Settings(host="0.0.0.0", hosts=tuple(hosts)).known_hosts
        assert {"localhost", "127.0.0.1", name} <= known  # of a browser, of the health check and of the proxy


def test_the_script_for_slurm_is_valid_and_ends_its_worker(tmp_path: Path) -> None:
    path = DEPLOY / "rths-workers.slurm"
    subprocess.run(["bash", "-n", path], check=True)
    if shutil.which("shellcheck"):
        subprocess.run(["shellcheck", path], check=True)
    home = tmp_path / "home"
    program = home / ".venv" / "bin" / "rths"
    program.parent.mkdir(parents=True)
    program.write_text('#!/bin/sh\necho "$@" "$RTHS_DATA" "$RTHS_SWEEP_PROCESSES"\n')
    program.chmod(0o755)
    (tmp_path / "environment").write_text("RTHS_WEB=wss://web\n")
    given = {"RTHS_HOME": str(home), "RTHS_ENVIRONMENT": str(tmp_path / "environment"), "SLURM_CPUS_PER_TASK": "3"}
    given |= {
        "SLURM_TMPDIR": str(tmp_path),
        "SLURM_JOB_ID": "7",
        "SLURM_ARRAY_TASK_ID": "2",
        "PATH": "/usr/bin:/bin",
        "HOME": "/",
    }
    said = subprocess.run(["bash", path], env=given, capture_output=True, text=True, check=True).stdout.split()
    *arguments, data, processes = said
    asked = parser().parse_args(arguments)
    assert (asked.command, asked.name, asked.web, processes) == ("worker", "slurm-7-2", "wss://web", "3")
    assert data.startswith(str(tmp_path)) and not Path(data).exists()
