"""`rths serve`: its address, the demonstration, Ctrl-C, and what it refuses."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.testclient import TestClient

from app import config
from app.cli.main import main
from app.cli.serve import PROXIES, only_server, reachable
from app.config import Settings, from_environment
from app.demonstration import queue_demonstration
from tests.app.conftest import app_of
from tests.browser.service import free_port, until

RTHS = [sys.executable, "-m", "app.cli"]


@pytest.fixture
def taken() -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as other:
        yield other.getsockname()[1]


@pytest.fixture
def free() -> int:
    return free_port()


@contextmanager
def serving(port: int, data: Path, *options: str) -> Iterator[httpx.Client]:
    """The control room from its first word to Ctrl-C, which must end it and all that it started."""
    command = [*RTHS, "serve", "--port", str(port), "--data", str(data), *options]
    # without the measuring of lines, whose own saving a Ctrl-C can interrupt
    environment = {name: value for name, value in os.environ.items() if not name.startswith("COV")}
    running = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True, env=environment
    )
    try:
        assert running.stdout is not None
        heading = [running.stdout.readline().strip() for _ in range(5)]
        assert heading[1] == f"RTHS control room: http://127.0.0.1:{port}/" and heading[3] == f"Data folder: {data}"
        assert heading[2].startswith("Everyone on this computer is signed in as administrator.")
        assert any("app.calculations.server" in one for one in children(running.pid)), "the first calculation would wait"
        with httpx.Client(base_url=f"http://127.0.0.1:{port}/api/v1", timeout=20) as http:
            yield http
        os.killpg(running.pid, signal.SIGINT)  # as a terminal does: to the service, its worker and the engines
        out, err = running.communicate()  # returns when no process is left that could write there
        assert running.returncode == 0 and out.endswith("Stopped.\n") and not err
    finally:
        if running.poll() is None:
            os.killpg(running.pid, signal.SIGKILL)
            running.communicate()


def children(pid: int) -> list[str]:
    """The commands of the processes that a process has started."""
    pids = [one for path in Path(f"/proc/{pid}/task").glob("*/children") for one in path.read_text().split()]
    return [Path(f"/proc/{one}/cmdline").read_text() for one in pids]


def runs(http: httpx.Client) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = http.get("/runs").raise_for_status().json()["runs"]
    return found


def test_one_demonstration_waits_however_often_the_control_room_starts(client: TestClient) -> None:
    def waiting() -> list[tuple[str, str]]:
        queue_demonstration(app_of(client))
        return sorted((run["state"], run["id"]) for run in client.get("/api/v1/runs").json()["runs"])

    ((state, first),) = waiting()
    plan = client.get(f"/api/v1/runs/{first}").json()["plan"]
    assert state == "queued" and plan["pace"] == {"kind": "real_time", "factor": 1.0, "core": None, "priority": None}
    assert waiting() == [("queued", first)]
    client.post(f"/api/v1/runs/{first}/cancel", json={}).raise_for_status()
    cancelled, (state, _) = waiting()
    assert cancelled == ("cancelled", first) and state == "queued"


def test_ctrl_c_ends_the_worker_and_its_engines_too(free: int, tmp_path: Path) -> None:
    """And a control room without a worker starts with the data that it finds."""
    with serving(free, tmp_path, "--demo", "--local") as http:
        until(lambda: runs(http)[0]["state"], lambda state: state == "running")
        assert runs(http)[0]["template"] == "table3-04"
    with serving(free, tmp_path, "--demo", "--local", "--no-worker") as http:
        assert len(runs(http)) == 1


def test_a_taken_port_is_refused_with_the_way_to_choose_another(
    taken: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["serve", "--port", str(taken), "--data", str(tmp_path)]) == 2
    assert (
        f"port = {taken}: is in use by another program" in (err := capsys.readouterr().err)
        and f"RTHS_PORT={taken + 1} make run" in err
    )


@pytest.mark.parametrize(
    ("options", "variable", "problem"),
    [
        (["--port", "70000"], None, "port = 70000: needs 1 to 65535"),
        (
            ["--local", "--host", "0.0.0.0"],
            None,
            "host = 0.0.0.0: can be reached from other computers",
        ),
        (["--host", "203.0.113.7"], None, "can't listen on this address"),
        (["--data", "/dev/null/rths"], None, "data folder = /dev/null/rths: can't be used"),
        ([], ("RTHS_PORT", "http"), "RTHS_PORT = http: needs a whole number"),
        ([], ("RTHS_DATABASE_URL", "nonsense"), "database: can't be opened"),
        ([], ("RTHS_DATABASE_URL", "postgresql://127.0.0.1:1/rths"), "database: can't be opened"),
    ],
)
def test_settings_no_service_can_use_are_refused(
    options: list[str],
    variable: tuple[str, str] | None,
    problem: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    if variable:
        monkeypatch.setenv(*variable)
    assert main(["serve", *options]) == 2
    assert problem in capsys.readouterr().err


def test_migrate_makes_a_database_that_the_service_opens(tmp_path: Path) -> None:
    assert main(["migrate", "--data", str(tmp_path)]) == 0
    assert (tmp_path / "rths.sqlite").exists()
    assert main(["migrate", "--data", str(tmp_path)]) == 0


def test_the_workers_token_is_kept_for_its_owner_only(tmp_path: Path) -> None:
    main(["migrate", "--data", str(tmp_path)])
    token = tmp_path / "worker-token"
    kept = token.read_text()
    main(["migrate", "--data", str(tmp_path)])
    assert token.read_text() == kept and token.stat().st_mode & 0o777 == 0o600


def test_a_service_on_a_network_says_for_which_hosts_it_answers_and_that_passwords_are_not_encrypted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(config, "own_names", lambda: frozenset({"control-room"}))
    monkeypatch.delenv(PROXIES, raising=False)
    open_to_all = Settings(host="0.0.0.0")
    said = reachable(open_to_all)
    assert "127.0.0.1, ::1, control-room, localhost and for every IP address" in said and "send passwords unencrypted" in said
    assert "unencrypted" not in reachable(replace(open_to_all, tls_certificate=tmp_path / "web.pem"))
    monkeypatch.setenv(PROXIES, "10.0.0.2")
    said = reachable(replace(open_to_all, hosts=("lab.example",)))
    assert "lab.example, localhost." in said and "unencrypted" not in said and "IP address" not in said


def test_the_data_folder_and_all_in_it_are_for_their_owner_only(tmp_path: Path) -> None:
    folder = tmp_path / "rths"
    before = os.umask(0o022)
    try:
        assert main(["account", "list", "--data", str(folder)]) == 0  # the first command that makes the database
        assert main(["migrate", "--data", str(folder)]) == 0
        assert main(["account", "add", "Ana", "--data", str(folder)]) == 0
    finally:
        assert os.umask(before) == 0o022  # what a command sets ends with it
    assert folder.stat().st_mode & 0o777 == 0o700
    assert not [one for one in folder.rglob("*") if one.stat().st_mode & 0o077]


def test_a_second_control_room_on_the_same_folder_is_refused(
    free: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = from_environment(data=tmp_path)
    with only_server(settings):
        assert main(["serve", "--port", str(free), "--data", str(tmp_path)]) == 2
        assert "is in use by another control room" in capsys.readouterr().err
    only_server(settings).close()
