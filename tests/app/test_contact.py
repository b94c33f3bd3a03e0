"""What a worker does that is cut off: a test goes on while the database or a web service knows of its worker."""

from __future__ import annotations

import json
import multiprocessing
import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.jobs.order import Order
from app.jobs.queue import DurableQueue
from app.jobs.service import JobService
from app.jobs.workers import Workers
from app.live.relay import Relay
from app.runs import job as runs_module
from app.runs.job import RUNS
from app.runs.service import RunService
from app.worker import child
from app.worker.child import ASSURED_S, Assured, CutOff, Line
from app.worker.contact import ASK_S, Contact
from rths_engine.parts.ground_motions import MotionLibrary
from tests.app.conftest import app_of, plan


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


class Executor:
    def __init__(self) -> None:
        self.stopped: list[tuple[str, int]] = []

    def executing(self) -> list[dict[str, Any]]:
        return [{"kind": "run", "id": "A", "attempt": 1}]

    def stop(self, job_id: str, attempt: int) -> None:
        self.stopped.append((job_id, attempt))

    def assure(self, left_s: float) -> None: ...


def test_a_worker_is_known_to_live_by_its_heartbeat_or_by_a_web_service() -> None:
    clock, executor = Clock(), Executor()
    contact = Contact(clock)
    contact.serve(executor, 2)
    clock.now += ASK_S / 2
    assert contact.question() is None
    contact.beaten(clock.now)
    assert contact.left_s == ASSURED_S
    clock.now += ASK_S
    question = contact.question()
    assert question == {"number": 1, "tests_at_a_time": 2, "executing": executor.executing()}
    clock.now += 1.0
    contact.answer({"number": 1})
    assert contact.left_s == ASSURED_S - 1.0  # from the moment of the question
    contact.answer({"number": 7, "stop": [{"id": "A", "attempt": 1}]})
    assert contact.left_s == ASSURED_S - 1.0 and executor.stopped == [("A", 1)]
    clock.now += ASSURED_S
    assert contact.left_s < 0


@pytest.fixture
def pipe(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Both ends of a pipe. A line whose pipe ends ends its process; here, its thread waits."""
    ended = threading.Event()

    def exit(_: int) -> None:
        ended.set()
        threading.Event().wait()

    monkeypatch.setattr("app.worker.child.os", SimpleNamespace(_exit=exit))
    ours, theirs = multiprocessing.Pipe()
    yield ours, theirs
    ours.close()
    assert ended.wait(20)


def test_a_process_that_moves_a_machine_stops_it_when_its_worker_is_silent(pipe: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "ASSURED_S", 0.05)
    ours, theirs = pipe
    line, stopped = Line(theirs), threading.Event()
    ours.send(Order("A", 1, moves=True))
    assert line.order().job_id == "A"
    line.stop_machine = stopped.set
    assert line.cancelled(within_s=20.0)
    assert isinstance(ours.recv(), CutOff)


def test_it_goes_on_while_its_worker_is_known_to_live_and_other_jobs_go_on_alone(
    pipe: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(child, "ASSURED_S", 0.05)
    ours, theirs = pipe
    line = Line(theirs)
    ours.send(Order("A", 1))
    line.order()
    assert not line.cancelled(within_s=0.3)
    monkeypatch.setattr(child, "ASSURED_S", 60.0)
    ours.send(Order("B", 1, moves=True))
    line.order()
    ours.send(Assured(0.0))
    assert not line.cancelled(within_s=0.3)


@pytest.mark.parametrize(("kind", "moves"), [("physical", True), ("emulated", False)])
def test_a_test_on_a_physical_rig_moves_a_machine(
    settings: Settings, monkeypatch: pytest.MonkeyPatch, kind: str, moves: bool
) -> None:
    monkeypatch.setattr(runs_module, "_approved", lambda run: "")
    job: Any = SimpleNamespace(id="A", attempt=1, plan=plan(), rig=SimpleNamespace(kind=kind))
    assert RUNS.order(job, settings).moves is moves


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    engine = db.connect(settings.url)
    yield db.sessions(engine)
    engine.dispose()


def test_a_service_beats_for_a_worker_and_tells_it_what_was_taken_over(maker: sessionmaker[Session]) -> None:
    queue = DurableQueue(maker.kw["bind"])
    with db.unit_of_work(maker) as session:
        ids = [run.id for run in RunService(session, MotionLibrary(None), queue).submit([plan(), plan()], "Ana Ruiz")]
    for worker in ("cut-1", "other-1"):  # the second takes one of them over
        for one in ids if worker == "cut-1" else ids[:1]:
            with db.unit_of_work(maker) as session:
                JobService(session, RUNS).start(one, worker)
    relay = Relay(maker, [RUNS])
    executing = [{"kind": "run", "id": one, "attempt": 1} for one in ids]
    found = relay.beat("cut-1", {"tests_at_a_time": 2, "executing": executing})
    assert found == [{"id": ids[0], "attempt": 1}]
    with db.unit_of_work(maker) as session:
        assert Workers(session).beats().keys() == {"cut-1"}
    relay.close()
    queue.close()


def test_a_worker_without_a_database_is_answered_over_its_websocket(client: TestClient) -> None:
    token = {"Authorization": f"Bearer {app_of(client).state.settings.worker_token}"}
    hello = {"worker": "cut-1", "latch": {"presses": [], "released": []}, "acknowledged": [], "stopping": []}
    executing = [{"kind": "run", "id": "gone", "attempt": 1}]
    with client.websocket_connect("/api/v1/worker", headers=token) as socket:
        socket.send_text(json.dumps(hello))
        socket.send_text(json.dumps({"contact": {"number": 3, "tests_at_a_time": 1, "executing": executing}}))
        told = [json.loads(socket.receive_text()) for _ in range(3)]
    assert [one["contact"] for one in told if "contact" in one] == [
        {"number": 3},
        {"number": 3, "stop": [{"id": "gone", "attempt": 1}]},
    ]
