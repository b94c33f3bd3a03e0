"""Sweeps on several workers: `python -m benchmarks.sweep_workers [--points 600] [--workers 1 2 4] [--store sqlite postgresql]`.

For each count a new control room starts with that many `rths worker` processes, each with one process for sweeps, and executes
one sweep of the two-storey frame. Printed is the time from the request to the last result, the points a second and their ratio
to those of the first count. More workers than cores share the cores.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx

from benchmarks.sweeps import definition, swept
from tests.app import postgres
from tests.browser.service import Service, free_port, until

STORES = ("sqlite", "postgresql")
TEMPLATE = "two-storeys"
WARM_POINTS = 8  # for each worker: its process starts, and is kept


@contextmanager
def started(arguments: list[str], environment: dict[str, str]) -> Iterator[int]:
    """A command of `rths` in a process of its own; its process id."""
    command = [str(Path(sys.executable).with_name("rths")), *arguments]
    process = subprocess.Popen(command, env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process.pid
    finally:
        process.terminate()
        process.wait(60)


@contextmanager
def room(workers: int, url: str) -> Iterator[Service]:
    """A control room with some workers that have been heard."""
    environment = {"RTHS_DATABASE_URL": url, "RTHS_WORKER_TOKEN": "benchmark", "RTHS_SWEEP_PROCESSES": "1"}
    port = free_port()
    with tempfile.TemporaryDirectory() as data, ExitStack() as open_:
        serve = ["serve", "--no-worker", "--local", "--data", data, "--port", str(port)]
        service = Service(f"http://127.0.0.1:{port}", Path(data), open_.enter_context(started(serve, environment)))
        until(lambda: _connected(service), lambda found: found is not None, 240)
        for number in range(workers):
            options = ["--data", data, "--web", f"ws://127.0.0.1:{port}", "--name", f"worker-{number}", "--workers", "1"]
            open_.enter_context(started(["worker", *options], environment))
        until(lambda: _connected(service), lambda found: found == workers, 240)
        yield service


def _connected(service: Service) -> int | None:
    try:
        return len(service.get("/abort")["workers"])
    except httpx.HTTPError:
        return None


def measured(store: str, workers: int, points: int) -> float:
    """Time (s) of the sweep on some workers."""
    with ExitStack() as open_:
        url = open_.enter_context(postgres.server()) if store == "postgresql" else ""
        service = open_.enter_context(room(workers, url))
        swept(service, definition(WARM_POINTS * workers, TEMPLATE))
        begun = time.perf_counter()
        swept(service, definition(points, TEMPLATE))
        return time.perf_counter() - begun


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=600)
    parser.add_argument("--workers", type=int, nargs="+", default=(1, 2, 4))
    parser.add_argument("--store", nargs="+", choices=STORES, default=STORES)
    given = parser.parse_args()
    print(f"{os.cpu_count()} cores, load average {os.getloadavg()[0]:.1f} before the first sweep, {given.points} points")
    for store in given.store:
        if store == "postgresql" and (missing := postgres.missing()):
            print(f"{store}: not measured: {missing}")
            continue
        first = 0.0
        for workers in given.workers:
            took = measured(store, workers, given.points)
            first = first or took
            rate, ratio = given.points / took, first / took
            print(f"{store:11} {workers} workers {took:7.1f} s {rate:7.1f} points/s, {ratio:.2f} times the first", flush=True)


if __name__ == "__main__":
    main()
