"""Time until Abort is acknowledged, and until the engine is idle, under load: `python -m benchmarks.abort [--presses 30]`.

Starts a control room with its worker and many stored runs, and for each load a test in real time. While another process makes
the load, Abort is pressed again and again; the first press stops the test. Prints median, 95th percentile and maximum.
The full disk needs root (a small tmpfs), the lost database a PostgreSQL server of its own; where one lacks, its line says so.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from app.config import Settings
from benchmarks.abort_loads import CLIENTS, load, small_disk, under
from benchmarks.control_room import control_room
from benchmarks.run_table import fill
from tests.app import postgres
from tests.browser.service import Service, until

TEST: dict[str, Any] = {"pace": {"kind": "real_time", "factor": 1.0}, "duration": 300.0}
ORDINARY = ("none", *CLIENTS, "locked")


def started(service: Service) -> None:
    """A test that runs."""
    service.wait(service.submit(**TEST), "running", within_s=240)


def measured(service: Service, presses: int) -> tuple[list[float], float]:
    """Times (ms) of the answers, and the time (ms) from the first press until no engine executes a test."""
    begun = time.perf_counter()
    times, idle = [], float("nan")
    for _ in range(presses):
        pressed = time.perf_counter()
        answer = service.post("/abort", {"by": "benchmark"})
        times.append(1e3 * (time.perf_counter() - pressed))
        if np.isnan(idle) and answer["acknowledged"] and not answer["running"]:
            idle = 1e3 * (time.perf_counter() - begun)
        time.sleep(0.02)
    return times, idle


def room(names: tuple[str, ...], presses: int, rows: int) -> None:
    """Measure some loads in one control room and print a line for each."""
    with tempfile.TemporaryDirectory() as outer, ExitStack() as open_:
        folder, database = Path(outer) / "data", None
        folder.mkdir()
        if "disk" in names:
            open_.enter_context(small_disk(folder))
        if "database" in names:
            database = postgres.Server()
            open_.callback(database.remove)
            database.start()
        stored = database.url if database else ""
        if rows:
            fill(Settings(data=folder, database_url=stored).prepared().url, rows)
        service = open_.enter_context(control_room(folder, stored))
        for name in names:
            service.post("/queue/release", {})
            started(service)
            with under(name, service.url, folder, database):
                times, idle = measured(service, presses)
            p50, p95 = np.percentile(times, [50, 95])
            print(f"{name:12} {p50:22.0f} {p95:5.0f} {max(times):5.0f} {idle:8.0f}", flush=True)
            until(lambda: service.get("/abort")["recorded"], bool, 240)
            _cancel_waiting(service)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--presses", type=int, default=30)
    parser.add_argument("--rows", type=int, default=23_000, help="runs that are stored before (default %(default)s)")
    parser.add_argument("--only", nargs="*", default=(*ORDINARY, "disk", "database"), help="loads to measure")
    parser.add_argument("--load", help=argparse.SUPPRESS)
    parser.add_argument("--url", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.load:
        asyncio.run(load(given.load, given.url))
        return
    print(f"{os.cpu_count()} cores, load average {os.getloadavg()[0]:.1f} before the first load")
    print("load         acknowledged, ms: p50   p95   max   engine idle, ms")
    if ordinary := tuple(name for name in given.only if name in ORDINARY):
        room(ordinary, given.presses, given.rows)
    if "disk" in given.only:
        if os.geteuid():
            print("disk         not measured: only root may mount a small disk")
        else:
            room(("disk",), given.presses, 0)
    if "database" in given.only:
        if missing := postgres.missing():
            print(f"database     not measured: {missing}")
        else:
            room(("database",), given.presses, 0)


def _cancel_waiting(service: Service) -> None:
    for one in service.get("/queue?limit=1000")["waiting"]:
        service.http.post(f"/api/v1/runs/{one['id']}/cancel", json={})


if __name__ == "__main__":
    main()
