"""The worker's link while the web service comes and goes: what was told is told again, and ended runs take no memory."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import pytest
import uvicorn
from websockets.sync.client import connect

from app.config import Settings
from app.live import frames
from app.live.frames import Decimator
from app.live.messages import progress, schema
from app.main import create_app
from app.worker.link import Link, Telling
from rths_engine.results.channels import Channel
from tests.browser.service import free_port, until

CHANNELS = (Channel("x_cmd", 1, "A"), Channel("d_alpha", 1, "B"))
RUN = "0" * 36
TOTAL = 900
ROW = 3 * 3 * 4  # bytes of a bucket: both channels and the command velocity


@pytest.fixture
def port() -> int:
    return free_port()


@contextmanager
def web(settings: Settings, port: int) -> Iterator[None]:
    """The web service in a thread; its hub knows nothing at first."""
    config = uvicorn.Config(create_app(settings), port=port, log_level="error", timeout_graceful_shutdown=1)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        until(lambda: server.started, bool)
        yield
    finally:
        server.should_exit = True
        thread.join()


@pytest.fixture
def link(settings: Settings, port: int) -> Link:
    return Link(f"ws://127.0.0.1:{port}/api/v1/worker", settings.worker_token)


@pytest.fixture
def tell(link: Link) -> tuple[Telling, Callable[[int], None]]:
    """What is told of a run, and how to tell more of it."""
    telling = Telling(RUN, 1)
    link.add(telling)
    signals = np.random.default_rng(1).normal(size=(TOTAL, 2))
    decimator = Decimator(CHANNELS, 1, 1e-3)
    telling.take(schema(1, 1e-3, 1, TOTAL, decimator.channels))

    def more(done: int) -> None:
        telling.take(decimator.frame(signals, done))
        telling.take(progress("running", done * 1e-3, 0.0, TOTAL * 1e-3))

    return telling, more


def seen(port: int, first: int, enough: int) -> bytes:
    """The buckets' bytes that a viewer gets from bucket `first` to bucket `enough`."""
    buckets = b""
    with connect(f"ws://127.0.0.1:{port}/api/v1/runs/{RUN}/live?from={first}") as viewer:
        while len(buckets) < (enough - first) * ROW:
            message = viewer.recv(timeout=60)
            if isinstance(message, bytes):
                buckets += message[8:]
    return buckets


def known(port: int) -> bool:
    with connect(f"ws://127.0.0.1:{port}/api/v1/runs/{RUN}/live") as viewer:
        try:
            told = json.loads(viewer.recv(timeout=60))
        except Exception:
            return False
        return bool(told["type"] == "schema")


def test_a_web_service_that_restarts_in_the_middle_of_a_test_is_told_all_of_it(
    settings: Settings, port: int, tell: tuple[Telling, Callable[[int], None]], monkeypatch: pytest.MonkeyPatch
) -> None:
    telling, more = tell
    more(400)
    with web(settings, port):
        until(lambda: known(port), bool)
        early = seen(port, 0, 400)
    monkeypatch.setattr(frames, "PIECE", 100 * ROW)  # the worker sends several frames
    more(600)
    with web(settings, port):
        until(lambda: known(port), bool)
        more(TOTAL)
        late = seen(port, 400, TOTAL)
        assert telling.store is not None
        monkeypatch.setattr(frames, "PIECE", TOTAL * ROW)
        whole = telling.store.since(0)
        assert whole is not None and early + late == whole[8:] == seen(port, 0, TOTAL)


def test_a_worker_with_a_wrong_token_says_so_in_its_log(
    settings: Settings, port: int, caplog: pytest.LogCaptureFixture
) -> None:
    with web(settings, port):
        Link(f"ws://127.0.0.1:{port}/api/v1/worker", "guess")
        until(lambda: caplog.text, lambda text: "wrong worker token" in text)


def test_runs_that_end_while_the_web_is_away_take_no_memory(link: Link, tell: tuple[Telling, Callable[[int], None]]) -> None:
    telling, more = tell
    more(TOTAL)
    assert telling.store is not None
    telling.ended = True
    until(lambda: [one.store for one in link._tellings], lambda stores: stores == [None])


def test_a_web_service_that_comes_back_is_told_of_ends_it_missed(
    settings: Settings, port: int, tell: tuple[Telling, Callable[[int], None]], link: Link
) -> None:
    telling, more = tell
    more(400)
    with web(settings, port):
        until(lambda: known(port), bool)
        telling.ended = True
        until(lambda: known(port), lambda still: not still)
    assert link._tellings == []
