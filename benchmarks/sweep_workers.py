"""`python -m benchmarks.sweep_workers [--store sqlite|postgresql] [--points N]`: one sweep on 1, 2 and 4 workers.

Each worker is a process of `rths worker` with one process for points, beside a web service without a worker. Workers share the
cores of this machine, so the rate grows until every core has one. It prints points per second for each number of workers.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import httpx

from benchmarks.sweeps import TEMPLATE, definition, swept
from tests.app import postgres
from tests.browser.service import ROOT, UNMEASURED, Service, free_port, until

WORKERS = (1, 2, 4)
POINTS = 400
STARTED_WITHIN_S = 240


@contextmanager
def served(folder: Path, database: str, workers: int) -> Iterator[Service]:
    """A web service and `workers` workers in processes of their own."""
    port = free_port()
    environment = {
        **UNMEASURED,
        "RTHS_DATABASE_URL": database,
        "RTHS_WORKER_TOKEN": "benchmark",
        "RTHS_SWEEP_PROCESSES": "1",
    }
    data = str(folder / "data")
    web = ["-m", "tests.chaos.web", data, str(port)]
    worker = ["-m", "app.worker", "--data", data, "--web", f"ws://127.0.0.1:{port}"]
    processes: list[subprocess.Popen[bytes]] = []
    with (folder / "log").open("wb") as log:

        def start(arguments: list[str]) -> None:
            command = [sys.executable, *arguments]
            processes.append(subprocess.Popen(command, cwd=ROOT, env=environment, stdout=log, stderr=log))

        try:
            start(web)
            service = Service(f"http://127.0.0.1:{port}", folder / "data", processes[0].pid)
            service.http.timeout = STARTED_WITHIN_S
            until(lambda: _ready(service), bool, STARTED_WITHIN_S)
            for number in range(workers):
                start([*worker, "--name", f"w{number}"])
            until(lambda: service.get("/queue")["tests_at_a_time"], lambda found: found >= workers, STARTED_WITHIN_S)
            yield service
        finally:
            for process in reversed(processes):
                process.terminate()
                process.wait(60)


def _ready(service: Service) -> bool:
    try:
        return service.http.get("/api/v1/queue").status_code == 200
    except httpx.HTTPError:
        return False


def rate(store: str, workers: int, points: int) -> float:
    """Points per second of a sweep on a number of workers, whose processes have started before."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        database = ""
        if store == "postgresql":
            server = postgres.Server()
            stack.callback(server.remove)
            server.start()
            database = server.url
        service = stack.enter_context(served(folder, database, workers))
        swept(service, definition(40 * workers, TEMPLATE))  # starts a process in every worker
        begun = time.perf_counter()
        swept(service, definition(points, TEMPLATE))
        return points / (time.perf_counter() - begun)


def main() -> dict[str, Any]:
    """The rates of a sweep for each number of workers."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.sweep_workers", description=__doc__)
    parser.add_argument("--store", choices=["sqlite", "postgresql"], default="sqlite")
    parser.add_argument("--points", type=int, default=POINTS)
    given = parser.parse_args()
    found = {f"{workers}": round(rate(given.store, workers, given.points), 2) for workers in WORKERS}
    return {
        "store": given.store,
        "points": given.points,
        "template": TEMPLATE,
        "cores": os.cpu_count(),
        "load": round(os.getloadavg()[1], 1),
        "points_per_s_by_workers": found,
    }


if __name__ == "__main__":
    print(json.dumps(main(), indent=2))
