"""What many viewers of one run share: bytes, moments of change, and questions to the database."""

from __future__ import annotations

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any, cast

import numpy as np
from fastapi import FastAPI

from app.cli.serve import Server
from app.config import Settings
from app.live import hub as hubs
from app.live.audience import Replay, Row, Watched
from app.live.frames import Decimator
from app.live.hub import Hub, LiveRun
from rths_engine.results.channels import Channel
from tests.coroutines import finished

CHANNELS = (Channel("x_cmd", 1, "A"), Channel("d_alpha", 1, "B"))
SCHEMA = {"type": "schema", "channels": [{}] * 3}
LONG_S = 3600.0


def frame(first: int, end: int) -> bytes:
    decimator = Decimator(CHANNELS, 1, 1e-3)
    decimator.sent = first
    made = decimator.frame(np.ones((end, 2)), end)
    assert made is not None
    return made


def test_viewers_at_the_same_bucket_share_the_bytes_of_a_frame() -> None:
    live = LiveRun(1, SCHEMA)
    live.store.append(frame(0, 4))
    assert live.since(1) is live.since(1) and live.since(4) is None
    live.store.append(frame(4, 9))
    assert live.since(4) == frame(4, 9) and live.since(1) is live.since(1)


def test_viewers_hear_of_changes_at_the_same_moment_and_of_the_end_at_once() -> None:
    async def scenario() -> tuple[bool, bool, bool]:
        hub = Hub()
        hub.take("run", 1, SCHEMA)
        live = hub.runs["run"]
        live.viewers = 2
        live.notify()
        second = live.changed
        live.notify(LONG_S)
        live.notify(LONG_S)
        early = second.is_set()
        hub.end("run", live)
        return early, second.is_set(), "run" in hub.runs

    assert finished(scenario()) == (False, True, False)


def test_more_viewers_get_fewer_frames_a_second() -> None:
    hub = Hub()
    hub.take("run", 1, SCHEMA)
    assert hub.gap == hubs.SHORTEST_GAP_S
    hub.runs["run"].viewers = 100
    assert hub.gap == 100 * hubs.COST_S < 0.1


def test_a_run_of_which_nothing_came_for_hours_is_forgotten_when_another_begins() -> None:
    hub = Hub()
    hub.take("old", 1, SCHEMA)
    hub.runs["old"].heard -= 2 * hubs.SILENT_S
    hub.take("new", 1, SCHEMA)
    assert list(hub.runs) == ["new"]


def from_nowhere(run_id: str) -> Replay:
    raise OSError(run_id)


def test_a_hundred_viewers_that_wait_ask_the_database_once() -> None:
    asked: list[str] = []

    def read(run_id: str) -> Row:
        asked.append(run_id)
        time.sleep(0.01)  # so that all of them ask meanwhile
        return cast("Row", object())

    async def scenario() -> list[Any]:
        with ThreadPoolExecutor(1) as threads:
            watched = Watched("run", read, from_nowhere, threads)
            rows = await asyncio.gather(*(watched.row() for _ in range(100)))
            await watched.row()
            early = len(asked)
            await watched.row(fresh_since=time.monotonic())
            return [len(set(map(id, rows))), early, len(asked)]

    assert finished(scenario()) == [1, 1, 2]


def test_live_values_are_not_compressed_for_each_viewer(settings: Settings) -> None:
    assert not Server(FastAPI(), settings, demonstrate=False).config.ws_per_message_deflate
