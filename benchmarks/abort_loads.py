"""What can keep a control room from hearing Abort: many requests, and a database or a disk that fails."""

from __future__ import annotations

import asyncio
import io
import sqlite3
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Any

import h5py
import httpx
import numpy as np
import websockets

from tests.app import postgres

STOREYS, LEAVE_S = 100, 5.0
CLIENTS = {"stability": 45, "submits": 50, "yaml": 8, "hdf5": 4, "pages": 20, "viewers": 100}
DISK_MB = 256


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
def requests(name: str, url: str) -> Iterator[None]:
    """Requests of one kind, made by a process of its own."""
    making = subprocess.Popen([sys.executable, "-m", "benchmarks.abort", "--load", name, "--url", url])
    try:
        time.sleep(LEAVE_S + 1)
        yield
    finally:
        making.kill()
        making.wait()
        time.sleep(1)


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Another program holds the lock of SQLite."""
    with sqlite3.connect(folder / "rths.sqlite", isolation_level=None, timeout=60) as other:
        other.execute("begin immediate")
        yield
        other.rollback()


@contextmanager
def full_disk(folder: Path) -> Iterator[None]:
    """The disk of the data has no byte left."""
    filler = folder / "filler"
    with filler.open("wb", buffering=0) as file:
        for size in (1 << 20, 512):
            with suppress(OSError):
                while True:
                    file.write(b"\0" * size)
    yield
    filler.unlink()


@contextmanager
def small_disk(folder: Path) -> Iterator[None]:
    """A disk of its own for a folder, small enough to be filled. Needs root."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK_MB}m", "tmpfs", folder], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


@contextmanager
def lost(database: postgres.Server) -> Iterator[None]:
    """The database server is killed, and starts again at the end."""
    database.kill()
    yield
    database.start()


def under(name: str, url: str, folder: Path, database: postgres.Server | None) -> AbstractContextManager[None]:
    """A load or a fault by its name."""
    if name == "none":
        return nullcontext()
    if name == "locked":
        return locked(folder)
    if name == "disk":
        return full_disk(folder)
    if name == "database":
        assert database is not None
        return lost(database)
    return requests(name, url)
