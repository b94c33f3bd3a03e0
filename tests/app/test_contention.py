"""Many requests that write at the same time: each waits for its turn, and none fails for the others."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import anyio.to_thread
import pytest
import sqlalchemy as sa
from fastapi import APIRouter
from fastapi.testclient import TestClient
from pydantic import BaseModel

from app import db, dependencies
from app.access import Role, allowed
from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, app_of, plan

RUNS = "/api/v1/runs"
MANY = 50


class Answer(BaseModel):
    number: int


def at_once(times: int, ask: Callable[[int], Any]) -> list[Any]:
    """The answers to requests that start together."""
    start = threading.Barrier(times)

    def one(number: int) -> Any:
        start.wait()
        return ask(number)

    with ThreadPoolExecutor(times) as threads:
        return list(threads.map(one, range(times)))


def test_fifty_submissions_at_once_are_all_queued(client: TestClient) -> None:
    answers = at_once(MANY, lambda number: client.post(RUNS, json={"plan": plan(name=f"Test {number}")}))
    assert [answer.status_code for answer in answers] == [201] * MANY
    runs = client.get(RUNS, params={"limit": 500}).json()["runs"]
    assert sorted(run["number"] for run in runs) == list(range(1, MANY + 1))
    assert len({run["name"] for run in runs}) == MANY


def test_a_request_that_writes_ends_while_all_others_wait_for_its_lock(settings: Settings) -> None:
    """With few threads: the answer of the request that has the lock is written in a thread."""
    app = create_app(settings)
    router = APIRouter()
    threads = 3

    @router.post("/slow")
    @allowed(Role.VIEWER)
    def slow(session: dependencies.OneSession) -> Answer:
        session.execute(sa.text("update queue_state set held = held"))
        return Answer(number=1)

    app.include_router(router)
    app.state.writing._value = threads - 1
    with TestClient(app, ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        assert client.portal is not None
        client.portal.call(_limit_threads, threads)
        answers = at_once(12, lambda _: client.post("/slow"))
    assert [answer.status_code for answer in answers] == [200] * 12


def _limit_threads(count: int) -> None:
    anyio.to_thread.current_default_thread_limiter().total_tokens = count


def test_a_service_that_stays_busy_says_when_to_try_again(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dependencies, "PATIENCE_S", 0.01)
    app_of(client).state.writing._value = 0
    answer = client.post(RUNS, json={"plan": plan()})
    assert (answer.status_code, answer.headers["retry-after"]) == (503, "5")
    assert client.get(RUNS).json()["total"] == 0


def test_a_pool_without_a_free_connection_is_no_server_error(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    engine = app_of(client).state.sessions.kw["bind"]
    monkeypatch.setattr(engine.pool, "_timeout", 0.01)
    held: list[sa.Connection] = []
    try:
        with pytest.raises(sa.exc.TimeoutError):
            while len(held) <= db.CONNECTIONS:
                held.append(engine.connect())
        answer = client.get(RUNS)
    finally:
        for one in held:
            one.close()
    assert (answer.status_code, answer.headers["retry-after"]) == (503, "5")


def test_two_requests_that_cancel_the_same_runs_in_opposite_orders_both_end(client: TestClient) -> None:
    ids = [run["id"] for run in client.post(RUNS, json={"plans": [plan(), plan()]}).json()["runs"]]
    orders = [ids, ids[::-1]]
    answers = at_once(2, lambda number: client.post("/api/v1/queue/cancel", json={"runs": orders[number]}))
    assert [answer.status_code for answer in answers] == [200, 200]
    assert sorted(len(answer.json()["cancelled"]) for answer in answers) == [0, 2]
