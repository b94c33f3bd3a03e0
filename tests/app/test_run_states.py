"""What workers and people do to a run at the same moment: one state, one result, and an abort that nothing slips through."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.jobs.aborts import Aborts
from app.jobs.hold import Hold
from app.jobs.repository import JobRepository
from app.jobs.service import JobService
from app.jobs.states import IllegalTransition, State
from app.latch import Latch
from app.models import Run
from app.queue.service import QueueService
from app.runs.job import RUNS
from app.runs.order import Outcome
from app.runs.schemas import RunOut
from app.runs.service import RunService
from rths_engine.parts.ground_motions import MotionLibrary
from tests.app.conftest import plan

PATIENCE_S = 10  # far above a statement's time; only a deadlock takes as long
LEAD_S = 0.5  # for a start that wrongly does not wait; one that waits outlasts it
SUMMARY: dict[str, Any] = {
    "status": "completed",
    "trip": None,
    "elapsed_s": 1.0,
    "simulated_s": 2.0,
    "floors_peak_mm": [10.0, 20.0],
    "input_energy_kNm": 30.0,
    "stations": [
        {"name": "one", "mte_mm": 1, "rms_percent": 2, "mti_mm2": 3, "mee_kNm": 4, "peak_stroke_mm": 5, "peak_force_kN": 6},
    ],
}


class FakeQueue:
    """Remembers what was queued."""

    def __init__(self) -> None:
        self.queued: list[str] = []

    def enqueue(self, session: Session, kind: Any, run_ids: Any) -> None:
        self.queued += run_ids


class BrokenQueue:
    def enqueue(self, session: Session, kind: Any, run_ids: Any) -> None:
        raise RuntimeError("the queue is gone")


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    engine = db.connect(settings.url)
    yield db.sessions(engine)
    engine.dispose()


def service(session: Session, queue: Any = None) -> RunService:
    return RunService(session, MotionLibrary(None), queue)


def queue(session: Session) -> QueueService:
    return QueueService(session)


def abort(session: Session, by: str = "Bo") -> list[str]:
    """Record a press of Abort."""
    return Aborts(session).record(Latch().press(by), [RUNS])


def jobs(session: Session) -> JobService[Run, Outcome]:
    return JobService(session, RUNS)


def submitted(maker: sessionmaker[Session]) -> str:
    with db.unit_of_work(maker) as session:
        return service(session, FakeQueue()).submit([plan()], "Ana")[0].id


def started(maker: sessionmaker[Session]) -> str:
    run_id = submitted(maker)
    with db.unit_of_work(maker) as session:
        assert jobs(session).start(run_id, "one").started is not None
    return run_id


def run_of(maker: sessionmaker[Session], run_id: str) -> Run:
    with db.unit_of_work(maker) as session:
        return service(session).get(run_id)


class Meanwhile:
    """A worker's start of a run in another thread, while a transaction of the test is open; it goes as far as it can."""

    def __init__(self, maker: sessionmaker[Session], run_id: str):
        self.found: list[Run | None] = []
        self._thread = threading.Thread(target=self._start, args=(maker, run_id))
        self._thread.start()
        self._thread.join(LEAD_S)

    def _start(self, maker: sessionmaker[Session], run_id: str) -> None:
        with db.unit_of_work(maker) as session:
            self.found.append(jobs(session).start(run_id, "other").started)

    def result(self) -> Run | None:
        self._thread.join(PATIENCE_S)
        return self.found[0]


def test_what_the_queue_does_not_take_is_not_stored(maker: sessionmaker[Session]) -> None:
    with pytest.raises(RuntimeError), db.unit_of_work(maker) as session:
        service(session, BrokenQueue()).submit([plan()], "Ana")
    with db.unit_of_work(maker) as session:
        assert session.scalar(sa.select(sa.func.count()).select_from(Run)) == 0


def test_a_run_cancelled_while_a_worker_takes_it_does_not_start(maker: sessionmaker[Session]) -> None:
    run_id = submitted(maker)
    with db.unit_of_work(maker) as session:
        service(session).cancel(run_id, "Bo")
        meanwhile = Meanwhile(maker, run_id)
    assert meanwhile.result() is None
    run = run_of(maker, run_id)
    assert (run.state, run.attempt) == (State.CANCELLED, 0)


def test_a_run_that_a_worker_takes_at_the_moment_of_an_abort_stays_queued(maker: sessionmaker[Session]) -> None:
    run_id = submitted(maker)
    with db.unit_of_work(maker) as session:
        assert abort(session) == []
        meanwhile = Meanwhile(maker, run_id)
    assert meanwhile.result() is None
    run = run_of(maker, run_id)
    assert (run.state, run.attempt) == (State.QUEUED, 0)


def test_a_cancel_sees_the_state_at_its_turn_not_the_one_it_read_before(maker: sessionmaker[Session]) -> None:
    run_id = submitted(maker)
    with db.unit_of_work(maker) as session:
        assert service(session).get(run_id).state is State.QUEUED
        with db.unit_of_work(maker) as other:
            assert jobs(other).start(run_id, "one").started is not None
        run = service(session).cancel(run_id, "Bo")
        assert (run.state, run.cancel_requested_by) == (State.RUNNING, "Bo")


def test_abort_asks_every_running_test_to_stop_and_leaves_waiting_ones(maker: sessionmaker[Session]) -> None:
    running, waiting = [started(maker), started(maker)], submitted(maker)
    with db.unit_of_work(maker) as session:
        assert abort(session) == running
    assert [run_of(maker, run_id).cancel_requested_by for run_id in [*running, waiting]] == ["Bo", "Bo", None]
    assert run_of(maker, waiting).state is State.QUEUED


def test_abort_holds_the_queue_even_when_a_test_ends_at_that_moment(
    maker: sessionmaker[Session], monkeypatch: pytest.MonkeyPatch
) -> None:
    run_id = started(maker)
    with db.unit_of_work(maker) as session:
        jobs(session).fail(run_id, 1, "crashed")
        monkeypatch.setattr(JobRepository, "ids", lambda *_: [run_id])
        assert abort(session) == []
    with db.unit_of_work(maker) as session:
        assert Hold(session).held
    assert run_of(maker, run_id).reason == "crashed"


def test_release_forgets_who_held_the_queue(maker: sessionmaker[Session]) -> None:
    acts: tuple[Callable[[QueueService], object], ...] = (lambda one: abort(one.session, " "), lambda one: one.release("Ana"))
    for act in acts:
        with db.unit_of_work(maker) as session:
            act(queue(session))
            state = queue(session).state()
        told = (state.held, state.held_by, state.held_at is not None)
        assert told in {(True, "unnamed", True), (False, None, False)}
    assert not state.held


def test_a_run_whose_cancel_its_dead_worker_missed_is_cancelled_when_taken_up(maker: sessionmaker[Session]) -> None:
    run_id = started(maker)
    with db.unit_of_work(maker) as session:
        service(session).cancel(run_id, "Bo")
    with db.unit_of_work(maker) as session:
        assert jobs(session).start(run_id, "other").started is None
    assert run_of(maker, run_id).state is State.CANCELLED


def test_a_result_before_the_start_is_refused_and_stores_nothing(maker: sessionmaker[Session]) -> None:
    run_id = submitted(maker)
    with pytest.raises(IllegalTransition), db.unit_of_work(maker) as session:
        jobs(session).finish(run_id, 0, Outcome(SUMMARY, "0" * 64, 1))
    run = run_of(maker, run_id)
    assert (run.state, run.stations, run.recording_sha256) == (State.QUEUED, [], None)


def test_a_failed_run_stays_failed_whatever_comes_later(maker: sessionmaker[Session]) -> None:
    run_id = started(maker)
    with db.unit_of_work(maker) as session:
        jobs(session).fail(run_id, 1, "its engine crashed")
    with db.unit_of_work(maker) as session:
        assert jobs(session).finish(run_id, 1, Outcome(SUMMARY, "0" * 64, 1)) is False
        jobs(session).fail(run_id, 1, "again")
    assert (run_of(maker, run_id).reason, run_of(maker, run_id).stations) == ("its engine crashed", [])


def test_a_measure_that_is_no_finite_number_is_stored_as_null(maker: sessionmaker[Session]) -> None:
    run_id = started(maker)
    stations = [{**SUMMARY["stations"][0], "rms_percent": math.nan, "peak_force_kN": math.inf}]
    summary = {**SUMMARY, "stations": stations, "floors_peak_mm": [math.inf, 2.0]}
    with db.unit_of_work(maker) as session:
        assert jobs(session).finish(run_id, 1, Outcome(summary, "0" * 64, 1))
    with db.unit_of_work(maker) as session:
        told = RunOut.of(service(session).get(run_id))
    shown = told.model_dump()
    assert [shown["stations"][0][key] for key in ("rms_percent", "peak_force_kN", "mte_mm")] == [None, None, 1]
    assert shown["floors_peak_mm"] == [None, 2.0]
