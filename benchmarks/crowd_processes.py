"""The processes of `benchmarks.crowd`: a worker that tells a run, viewers that watch it, and clients that submit tests."""

from __future__ import annotations

import asyncio
import json
import struct
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import httpx
from websockets.asyncio.client import connect as watch
from websockets.exceptions import ConnectionClosedError
from websockets.sync.client import connect

from app.live.messages import progress
from app.live.uplink import FRAME_HEADER

HEADER = struct.Struct("<II")
CHANNELS = 24  # a test with two stations
VALUES = 3
EVERY_S = 0.02  # as the worker's link sends
BUCKETS = 7  # buckets of a frame: a test in real time at 1024 Hz
SHORT_RUN = 200  # buckets of a run that nobody watches
POLL_S = 0.5  # of a client that waits for its test


class Worker:
    """A connection like that of a worker. `sent[n]` is the time at which frame n left (monotonic, s)."""

    def __init__(self, web: str, token: str):
        headers = {"Authorization": f"Bearer {token}"}
        self.socket = connect(f"ws{web[4:]}/api/v1/worker", additional_headers=headers, compression=None, max_size=None)

    def say(self, run_id: str, message: dict[str, Any]) -> None:
        self.socket.send(json.dumps({"run_id": run_id, "attempt": 1, "message": message}))

    def begin(self, run_id: str, buckets: int) -> None:
        facts = {"role": "x", "label": "", "unit": "mm", "factor": 1e-3}
        channels = [{"key": f"x.{one}", "number": one, **facts} for one in range(CHANNELS)]
        grid = {"attempt": 1, "dt": 1 / 1024, "bucket": 3, "buckets": buckets}
        self.say(run_id, {"type": "schema", **grid, "channels": channels})

    def frame(self, run_id: str, first: int, count: int) -> None:
        values = bytes(count * CHANNELS * VALUES * 4)
        self.socket.send(FRAME_HEADER.pack(run_id.encode(), 1) + HEADER.pack(first, count) + values)

    def tell(self, run_id: str, sent: Any, frames: int) -> None:
        """Tell a run at the pace of a test in real time."""
        begun = time.monotonic()
        for number in range(frames):
            time.sleep(max(0.0, begun + number * EVERY_S - time.monotonic()))
            sent[number] = time.monotonic()
            self.frame(run_id, number * BUCKETS, BUCKETS)
            self.say(run_id, progress("running", number * EVERY_S, number * EVERY_S, frames * EVERY_S))
        self.say(run_id, {"type": "end"})

    def tell_short(self, run_id: str) -> None:
        """Tell a short run that nobody watches, as fast as possible."""
        self.begin(run_id, SHORT_RUN)
        self.frame(run_id, 0, SHORT_RUN)
        self.say(run_id, progress("running", 0.6, 0.1, 0.6))
        self.say(run_id, {"type": "end"})


def view(web: str, run_id: str, viewers: int, sent: Any, ready: Any, answers: Any) -> None:
    """Watch a run as many viewers; puts the ages of buckets and the gaps between frames (s) of each viewer into `answers`."""
    answers.put(asyncio.run(_viewers(web, run_id, viewers, sent, ready)))


async def _viewers(web: str, run_id: str, viewers: int, sent: Any, ready: Any) -> list[tuple[list[float], list[float]]]:
    waiting = [asyncio.Event() for _ in range(viewers)]
    tasks = [asyncio.create_task(_viewer(web, run_id, sent, one)) for one in waiting]
    await asyncio.gather(*(one.wait() for one in waiting))
    ready.set()
    return list(await asyncio.gather(*tasks))


async def _viewer(web: str, run_id: str, sent: Any, open_: asyncio.Event) -> tuple[list[float], list[float]]:
    """The age of the oldest bucket of each frame when it arrives, and the gaps between frames (s)."""
    ages: list[float] = []
    gaps: list[float] = []
    before = 0.0
    async with watch(f"ws{web[4:]}/api/v1/runs/{run_id}/live", compression=None, max_size=None) as socket:
        with suppress(ConnectionClosedError):  # the database knows nothing of a scripted run
            async for message in socket:
                if isinstance(message, str):
                    open_.set()
                    continue
                now = time.monotonic()
                first, _ = HEADER.unpack_from(message)
                ages.append(now - sent[first // BUCKETS])
                if before:
                    gaps.append(now - before)
                before = now
    return ages, gaps


def submit(web: str, plan: dict[str, Any], clients: int, seconds: float, most: int, ready: Any, answers: Any) -> None:
    """Submit tests as many clients for a time (s) or `most` tests; puts the times of their requests (s) into `answers`."""
    until = time.monotonic() + seconds
    ready.set()
    times: list[float] = []
    left = threading.Semaphore(most)
    threads = [threading.Thread(target=_client, args=(web, plan, number, until, left, times)) for number in range(clients)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    answers.put(times)


def _client(web: str, plan: dict[str, Any], number: int, until: float, left: threading.Semaphore, times: list[float]) -> None:
    with httpx.Client(base_url=web, timeout=60) as http:
        while time.monotonic() < until and left.acquire(blocking=False):
            begun = time.monotonic()
            answer = http.post("/api/v1/runs", json={"plan": {**plan, "seed": number}, "submitted_by": f"Client {number}"})
            times.append(time.monotonic() - begun)
            run = answer.raise_for_status().json()["runs"][0]["id"]
            while time.monotonic() < until and not ended(http.get(f"/api/v1/runs/{run}").json()["state"]):
                time.sleep(POLL_S)


def ended(state: str) -> bool:
    """Whether a test in this state has ended."""
    return state in ("completed", "tripped", "cancelled", "failed")


def at(values: Sequence[float], share: float) -> float:
    """The value below which a share of the values lies."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(share * (len(ordered) - 1)))] if ordered else float("nan")
