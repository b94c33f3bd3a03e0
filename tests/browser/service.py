"""A running service, seen through its REST interface, for setting up what a browser test looks at."""

from __future__ import annotations

import os
import random
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import httpx

STARTED_WITHIN_S = 240  # compiling the engine's loop for the first time, on a busy machine, included
ENDED = {"completed", "tripped", "cancelled", "failed"}
ROOT = Path(__file__).parents[2]
DATABASE_URL = os.environ.get("RTHS_TEST_DATABASE_URL", "")
"""Database of whole services in tests, such as postgresql://...; by default SQLite in the data folder."""
ENVIRONMENT = {**os.environ, "RTHS_DATABASE_URL": DATABASE_URL}
UNMEASURED = {name: value for name, value in ENVIRONMENT.items() if not name.startswith("COV")}
"""The environment of a process that is killed: it could not save which of its lines were executed."""


class Service:
    def __init__(self, url: str, data: Path, pid: int):
        self.url, self.data, self.pid = url, data, pid
        self.http = httpx.Client(base_url=url, timeout=60)

    def get(self, path: str) -> Any:
        return self.http.get(f"/api/v1{path}").raise_for_status().json()

    def post(self, path: str, data: Any) -> Any:
        return self.http.post(f"/api/v1{path}", json=data).raise_for_status().json()

    def plan(self, template: str = "two-storeys", **changes: Any) -> dict[str, Any]:
        return {**self.get(f"/templates/{template}")["plan"], **changes}

    def submit(self, by: str = "Ana Ruiz", **changes: Any) -> str:
        """Queue simulation 4 of Table III with some of it changed; its id."""
        run: str = self.post("/runs", {"plan": self.plan(**changes), "submitted_by": by})["runs"][0]["id"]
        return run

    def wait(self, run_id: str, *states: str, within_s: float = 120) -> dict[str, Any]:
        """The run once it is in one of the states (by default: once it has ended); fails when it ends in another."""
        run: dict[str, Any] = until(
            lambda: self.get(f"/runs/{run_id}"), lambda run: run["state"] in ENDED.union(states), within_s
        )
        assert not states or run["state"] in states, f"{run['name']} is {run['state']}: {run['reason']}"
        return run

    def completed(self, **changes: Any) -> str:
        """A short run that has ended."""
        run = self.submit(**{"duration": 3.0, **changes})
        self.wait(run, "completed")
        return run

    def warm_up(self) -> None:
        """Execute a first test and a first dry run, for which the engine is compiled where it is not yet."""
        self.http.post("/api/v1/plans/preflight", json={"plan": self.plan(duration=3.0)}, timeout=STARTED_WITHIN_S)
        self.wait(self.submit(duration=3.0), "completed", within_s=STARTED_WITHIN_S)

    def idle(self) -> None:
        """Cancel what is under way and release the queue, so that a test starts from nothing."""
        for state in ("queued", "running"):
            for run in self.get(f"/runs?state={state}&limit=500")["runs"]:
                self.http.post(f"/api/v1/runs/{run['id']}/cancel", json={})
        until(lambda: self.get("/queue"), lambda queue: not queue["running"] and not queue["queued"])
        self.post("/queue/release", {})


def until(look: Callable[[], Any], good: Callable[[Any], bool], within_s: float = 60) -> Any:
    deadline = time.monotonic() + within_s
    while not good(found := look()):
        assert time.monotonic() < deadline, f"still {found} after {within_s} s"
        time.sleep(0.1)
    return found


def free_port() -> int:
    """A port that nothing listens on, below those that the system gives to connections while a server is starting."""
    while True:
        port = random.randrange(20_000, 32_000)
        with socket.socket() as probe, suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def importing(path: Path) -> dict[str, str]:
    """The environment of a process of this project that imports from the folder `path` first."""
    return {**ENVIRONMENT, "PYTHONPATH": os.pathsep.join([str(path), str(ROOT)])}


@contextmanager
def running(data: Path, path: Path | None = None, calculating: bool = False) -> Iterator[Service]:
    """The service in a process of its own on a free port, its data in the folder `data`.

    Its processes import what the folder `path` holds before they start, such as a module `sitecustomize`. With `calculating`
    the modules of calculations are loaded while the service starts, not at the first calculation.
    """
    port = free_port()
    with (data / "service.log").open("wb") as log:
        folder = data / "rths"
        command = [
            sys.executable,
            "-m",
            "tests.browser.serve",
            str(folder),
            str(port),
            *(["calculating"] if calculating else []),
        ]
        environment = importing(path) if path else ENVIRONMENT
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT)
        service = Service(f"http://127.0.0.1:{port}", folder, process.pid)
        try:
            until(lambda: _ready(service, process), bool, STARTED_WITHIN_S)
            yield service
        finally:
            service.http.close()
            process.terminate()
            process.wait(60)


def _ready(service: Service, process: subprocess.Popen[bytes]) -> bool:
    assert process.poll() is None, "the service ended at its start; its log says why"
    try:
        return bool(service.get("/queue")["worker_alive"])
    except (httpx.HTTPError, KeyError):
        return False
