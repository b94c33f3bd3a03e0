"""Deployment files: their commands and settings exist, and the tools that read them accept them."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from app.cli.main import parser
from app.config import VARIABLES

ROOT = Path(__file__).parent.parent
DEPLOY = ROOT / "docs" / "deploy"
UNITS = sorted(DEPLOY.glob("*.service"))
OTHER = frozenset({"RTHS_CACHE", "RTHS_WEB", "RTHS_SITE", "RTHS_HOME", "RTHS_ENVIRONMENT"})  # of scripts and compiler
KNOWN = {one.key for one in VARIABLES.values()} | OTHER


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
