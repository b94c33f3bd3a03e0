"""Time until Abort is acknowledged, and until the engine is idle, under load: `python -m benchmarks.abort [--presses 30]`.

Starts a control room with its worker in a folder of its own, and for each load a test in real time. While another process makes
the load, Abort is pressed again and again; the first press stops the test. Prints median, 95th percentile and maximum.
"""

from __future__ import annotations

import argparse
import asyncio
import io
import os
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import httpx
import numpy as np
import websockets

from tests.browser.service import free_port, until

STOREYS, LEAVE_S = 100, 5.0
CLIENTS = {"stability": 45, "submits": 50, "yaml": 8, "hdf5": 4, "pages": 20, "viewers": 100}
TEST = {"pace": {"kind": "real_time", "factor": 1.0}, "duration": 300.0}


def tall(plan: dict[str, Any]) -> dict[str, Any]:
    """A plan of many storeys, about 9 kB."""
    storey = plan["structure"]["storeys"][0]
    return {**plan, "structure": {**plan["structure"], "storeys": [storey] * STOREYS}}


def expanding() -> bytes:
    """A small HDF5 file of 200 MB of zeros."""
    held = io.BytesIO()
    with h5py.File(held, "w") as file:
        file.create_dataset("displacement", data=np.zeros(25_000_000), compression="gzip", compression_opts=9)
    return held.getvalue()


async def load(name: str, url: str) -> None:
    """Make a load for ever."""
    async with httpx.AsyncClient(base_url=f"{url}/api/v1", timeout=60, limits=httpx.Limits(max_connections=None)) as http:
        plan = (await http.get("/templates/two-storeys")).json()["plan"]
        high, text, file = tall(plan), "notes: " + "- [a, b, {c: d}]\n" * 45_000, expanding() if name == "hdf5" else b""
        run = (await http.get("/runs?state=running&limit=1")).json()["runs"]
        actions: dict[str, Callable[[], Awaitable[object]]] = {
            "stability": lambda: http.post("/stability", json=high, timeout=LEAVE_S),
            "submits": lambda: http.post("/runs", json={"plan": {**plan, "duration": 1.0}}),
            "yaml": lambda: http.post("/plans/read", content=text, headers={"content-type": "application/yaml"}),
            "hdf5": lambda: http.post("/recordings/files", files={"file": ("sheet.h5", file)}),
            "pages": lambda: http.get("/runs?limit=500&sort=elapsed_s"),
            "viewers": lambda: watched(url, run[0]["id"]),
        }
        await asyncio.gather(*(again(actions[name]) for _ in range(CLIENTS[name])))


async def watched(url: str, run: str) -> None:
    """Watch a run."""
    async with websockets.connect(f"{url.replace('http', 'ws', 1)}/api/v1/runs/{run}/live", max_size=None) as socket:
        async for _ in socket:
            pass


async def again(action: Callable[[], Awaitable[object]]) -> None:
    """Repeat an action for ever, also where it fails."""
    while True:
        try:
            await action()
        except (httpx.HTTPError, OSError, websockets.WebSocketException):
            await asyncio.sleep(0.05)


@contextmanager
def control_room(folder: Path) -> Iterator[tuple[httpx.Client, str]]:
    """A control room in processes of its own, and a client that keeps its connection."""
    port = free_port()
    command = [str(Path(sys.executable).with_name("rths")), "serve", "--local", "--data", str(folder), "--port", str(port)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    url = f"http://127.0.0.1:{port}"
    try:
        with httpx.Client(base_url=f"{url}/api/v1", timeout=120) as http:
            until(lambda: _answers(http), bool, 240)
            yield http, url
    finally:
        process.terminate()
        process.wait(60)


def _answers(http: httpx.Client) -> bool:
    try:
        return bool(http.get("/abort").json()["workers"])
    except httpx.HTTPError:
        return False


def started(http: httpx.Client) -> None:
    """A test that runs."""
    plan = http.get("/templates/two-storeys").json()["plan"] | TEST
    run = http.post("/runs", json={"plan": plan}).raise_for_status().json()["runs"][0]["id"]
    until(lambda: http.get(f"/runs/{run}").json()["state"], lambda state: state == "running", 240)


def measured(http: httpx.Client, presses: int) -> tuple[list[float], float]:
    """Times (ms) of the answers, and the time (ms) from the first press until no engine executes a test."""
    begun = time.perf_counter()
    times, idle = [], float("nan")
    for _ in range(presses):
        pressed = time.perf_counter()
        answer = http.post("/abort", json={"by": "benchmark"}).raise_for_status().json()
        times.append(1e3 * (time.perf_counter() - pressed))
        if np.isnan(idle) and answer["acknowledged"] and not answer["running"]:
            idle = 1e3 * (time.perf_counter() - begun)
        time.sleep(0.02)
    return times, idle


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--presses", type=int, default=30)
    parser.add_argument("--only", nargs="*", default=("none", *CLIENTS, "locked"), help="loads to measure")
    parser.add_argument("--load", help=argparse.SUPPRESS)
    parser.add_argument("--url", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.load:
        asyncio.run(load(given.load, given.url))
        return
    print(f"{os.cpu_count()} cores, load average {os.getloadavg()[0]:.1f} before the first load")
    print("load         acknowledged, ms: p50   p95   max   engine idle, ms")
    with tempfile.TemporaryDirectory() as folder, control_room(Path(folder)) as (http, url):
        for name in given.only:
            http.post("/queue/release", json={})
            started(http)
            with _under(name, url, Path(folder)):
                times, idle = measured(http, given.presses)
            p50, p95 = np.percentile(times, [50, 95])
            print(f"{name:12} {p50:22.0f} {p95:5.0f} {max(times):5.0f} {idle:8.0f}", flush=True)
            until(lambda: http.get("/abort").json()["recorded"], bool, 240)
            _cancel_waiting(http)


@contextmanager
def _under(name: str, url: str, folder: Path) -> Iterator[None]:
    if name == "none":
        yield
    elif name == "locked":
        with sqlite3.connect(folder / "rths.sqlite", isolation_level=None, timeout=60) as other:
            other.execute("begin immediate")
            yield
            other.rollback()
    else:
        making = subprocess.Popen([sys.executable, "-m", "benchmarks.abort", "--load", name, "--url", url])
        try:
            time.sleep(LEAVE_S + 1)
            yield
        finally:
            making.kill()
            making.wait()
            time.sleep(1)


def _cancel_waiting(http: httpx.Client) -> None:
    for one in http.get("/queue?limit=1000").json()["waiting"]:
        http.post(f"/runs/{one['id']}/cancel", json={})


if __name__ == "__main__":
    main()
