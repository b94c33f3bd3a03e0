"""Abort: a latch that merges in any order, and an answer whatever threads, calculations, database and disk do."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import anyio.to_thread
import httpx
import sqlalchemy as sa
import uvicorn
from fastapi import FastAPI
from fastapi.testclient import TestClient

from app.calculations.turns import Turns
from app.config import Settings
from app.jobs.tables import AbortPress
from app.latch import Latch
from app.main import create_app
from app.worker.link import Links
from app.worker.stopping import Stopper
from tests.browser.service import free_port, until


def test_a_latch_takes_news_in_any_order_and_more_than_once() -> None:
    here, there, late = Latch(), Latch(), Latch()
    first = here.press("Ana")
    early = here.as_dict()
    there.take(early)
    second = there.press("Bo")
    there.merge([], [first.id])
    assert there.presses == [second] and here.held
    late.take(there.as_dict())
    late.take(early)  # the press of a service that does not know of its release yet
    assert late.presses == [second]
    here.take(late.as_dict())
    assert here.presses == [second] and here.by == "Bo"
    here.merge([], [second.id])
    assert not here.held and here.by is None


@contextmanager
def web(settings: Settings, port: int) -> Iterator[FastAPI]:
    """A web service in a thread."""
    app = create_app(settings)
    server = uvicorn.Server(uvicorn.Config(app, port=port, log_level="error", timeout_graceful_shutdown=1))
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        until(lambda: server.started, bool)
        yield app
    finally:
        server.should_exit = True
        thread.join()


class Engines:
    """What a worker executes: tests that stop when they are asked to."""

    def __init__(self) -> None:
        self.running, self.asked = ["a" * 36], False

    def stop(self) -> list[str]:
        self.asked = True
        return self.running


def worker(settings: Settings, ports: list[int]) -> tuple[Latch, Engines]:
    """The part of a worker that hears of Abort, connected to web services."""
    latch, engines = Latch(), Engines()
    stopper = Stopper(latch)
    Links(",".join(f"ws://127.0.0.1:{port}" for port in ports), settings.worker_token, "rig 1", stopper)
    stopper.start(engines.stop)
    return latch, engines


def ask(port: int, path: str = "abort", by: str | None = None) -> dict[str, Any]:
    url = f"http://127.0.0.1:{port}/api/v1/{path}"
    answer = httpx.get(url, timeout=60) if by is None else httpx.post(url, json={"by": by}, timeout=60)
    found: dict[str, Any] = answer.raise_for_status().json()
    return found


@contextmanager
def locked(data: Path) -> Iterator[None]:
    """Another connection holds the lock of the database."""
    with sqlite3.connect(data / "rths.sqlite", isolation_level=None, timeout=60) as other:
        other.execute("begin immediate")
        try:
            yield
        finally:
            other.rollback()


def stored(data: Path) -> list[tuple[Any, ...]]:
    with sqlite3.connect(data / "rths.sqlite") as other:
        return other.execute("select pressed_by, released_at is not null from abort_press").fetchall()


def test_a_worker_hears_of_abort_while_the_database_is_locked_and_the_record_follows(settings: Settings) -> None:
    port = free_port()
    with web(settings, port):
        latch, engines = worker(settings, [port])
        until(lambda: ask(port)["workers"], lambda found: [one["name"] for one in found] == ["rig 1"])
        with locked(settings.data):
            answer = ask(port, by="Bo")
            assert (answer["held"], answer["by"], answer["recorded"]) == (True, "Bo", False)
            until(lambda: ask(port)["acknowledged"], bool)
            found = ask(port)
            assert engines.asked and latch.held
            assert found["stopping"] == found["running"] == engines.running
            assert "Acknowledged by every connected worker. 1 test is still stopping." in found["sentence"]
            assert "the database has not stored the hold yet" in found["sentence"]
            engines.running = []
            until(lambda: ask(port)["running"], lambda running: running == [])
        until(lambda: ask(port)["recorded"], bool)
        assert ask(port)["sentence"].endswith("No test of these workers runs. The queue is held.")
        assert ask(port, "queue")["held_by"] == "Bo"
        ask(port, "queue/release", "Ana")
        until(lambda: latch.held, lambda held: not held)
        assert not ask(port)["held"] and stored(settings.data) == [("Bo", 1)]


def test_a_service_that_restarts_before_the_record_is_told_by_the_worker(settings: Settings) -> None:
    port = free_port()
    with locked_after_start(settings, port) as latch:
        ask(port, by="Bo")
        until(lambda: latch.held, bool)
    with web(settings, port):
        until(lambda: ask(port)["recorded"], bool)
        assert ask(port, "queue")["held_by"] == "Bo"


@contextmanager
def locked_after_start(settings: Settings, port: int) -> Iterator[Latch]:
    """A service with a worker, whose database is locked until it has ended."""
    with web(settings, port) as app:
        app.state.desk.recorder.stop()  # as if the lock lasted until its end
        latch, _ = worker(settings, [port])
        until(lambda: ask(port)["workers"], bool)
        yield latch


def test_abort_and_release_reach_every_service_of_a_worker(settings: Settings, tmp_path: Path) -> None:
    one, two = free_port(), free_port()
    with web(settings, one) as first, web(settings, two) as second:
        latch, _ = worker(settings, [one, two])
        until(lambda: len(ask(one)["workers"]) + len(ask(two)["workers"]), lambda count: count == 2)
        ask(one, by="Bo")
        until(lambda: second.state.desk.latch.held, bool)
        until(lambda: ask(two)["recorded"], bool)
        ask(two, "queue/release", "Ana")
        until(lambda: first.state.desk.latch.held or latch.held, lambda held: not held)
        assert not ask(one)["held"]


def test_a_release_without_a_connection_is_read_from_the_database(settings: Settings) -> None:
    one, two = free_port(), free_port()
    with web(settings, one), web(settings, two):
        ask(one, by="Bo")
        until(lambda: ask(one)["recorded"], bool)
        assert ask(two, "queue")["held"]
        ask(two, "queue/release", "Ana")
        until(lambda: ask(one)["held"], lambda held: not held)


def test_abort_answers_while_every_thread_and_every_place_of_a_calculation_is_taken(client: TestClient) -> None:
    let_go, taken = threading.Event(), threading.Semaphore(0)

    def block() -> None:
        taken.release()
        let_go.wait(60)

    async def fill() -> int:
        limiter = anyio.to_thread.current_default_thread_limiter()
        async with anyio.create_task_group() as group:
            for _ in range(int(limiter.total_tokens)):
                group.start_soon(anyio.to_thread.run_sync, block)
        return int(limiter.total_tokens)

    assert client.portal is not None
    filled = client.portal.start_task_soon(fill)
    app: Any = client.app
    app.state.calculations.short = app.state.calculations.long = Turns(0)
    try:
        for _ in range(2):
            taken.acquire(timeout=60)
        assert client.post("/api/v1/abort", json={"by": "Bo"}).json()["held"]
        assert client.get("/api/v1/abort").json()["by"] == "Bo"
        assert client.get("/healthz").json()["database"] == "ok"
    finally:
        let_go.set()
        filled.result(60)


def test_abort_is_recorded_once_the_disk_takes_it(client: TestClient) -> None:
    app: Any = client.app
    recorder, tried = app.state.desk.recorder, threading.Event()
    pages = [1]

    @sa.event.listens_for(recorder._engine, "begin")
    def limit(connection: sa.Connection) -> None:
        connection.exec_driver_sql(f"pragma max_page_count={pages[0]}")
        tried.set()

    @sa.event.listens_for(AbortPress, "before_insert")
    def grow(mapper: Any, connection: sa.Connection, press: AbortPress) -> None:
        if pages[0] == 1:
            connection.exec_driver_sql("create table filler as select hex(zeroblob(100000)) as text")

    try:
        answer = client.post("/api/v1/abort", json={"by": "Bo"}).json()
        assert tried.wait(60) and (answer["held"], answer["recorded"]) == (True, False)
        assert client.get("/api/v1/queue").json()["held_by"] == "Bo"
        pages[0] = 1_000_000
        until(lambda: client.get("/api/v1/abort").json()["recorded"], bool)
    finally:
        sa.event.remove(AbortPress, "before_insert", grow)
