"""What a change of the program's version does to jobs: none is stranded, and none is repeated without a person who asks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import sqlalchemy as sa
from dbos import Queue as DbosQueue
from dbos._error import DBOSException
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.events.tables import Event
from app.jobs import service as module
from app.jobs.queue import VERSION, DurableQueue
from app.jobs.service import JobService
from app.jobs.states import State
from app.models import Rig, Run, SweepShard
from app.runs.job import RUNS
from app.runs.service import RunService
from app.sweeps.job import SHARDS
from rths_engine.parts.ground_motions import MotionLibrary
from tests.app.conftest import app_of, plan
from tests.app.test_run_states import FakeQueue

NEXT = "99.0.0"


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    engine = db.connect(settings.url)
    yield db.sessions(engine)
    engine.dispose()


@pytest.fixture
def upgraded(monkeypatch: pytest.MonkeyPatch) -> Any:
    """A call after which the program has another version."""
    return lambda: monkeypatch.setattr(module, "__version__", NEXT)


def submit(maker: sessionmaker[Session]) -> str:
    with db.unit_of_work(maker) as session:
        return RunService(session, MotionLibrary(None), FakeQueue()).submit([plan()], "Ana")[0].id


def delivered(maker: sessionmaker[Session], turn: str = "turn") -> Run | None:
    with db.unit_of_work(maker) as session:
        return JobService(session, RUNS).start(turn, "lab-1").started


def run_of(maker: sessionmaker[Session], run_id: str) -> Run:
    with db.unit_of_work(maker) as session:
        return session.scalars(sa.select(Run).where(Run.id == run_id)).one()


def started(maker: sessionmaker[Session]) -> str:
    newest = sa.select(Event.sentence).where(Event.kind == "started").order_by(Event.number.desc())
    with db.unit_of_work(maker) as session:
        return session.scalars(newest).first() or ""


def test_a_run_that_an_earlier_version_queued_starts_and_says_so(maker: sessionmaker[Session], upgraded: Any) -> None:
    run_id = submit(maker)
    before = run_of(maker, run_id).code_version
    upgraded()
    assert delivered(maker) is not None
    run = run_of(maker, run_id)
    assert (run.state, run.code_version, run.started_version) == (State.RUNNING, before, NEXT)
    assert f"Version {before} of the program queued it, version {NEXT} executes it." in started(maker)


def test_a_run_that_a_change_of_version_tore_off_ends_and_is_repeated_only_when_asked(
    maker: sessionmaker[Session], upgraded: Any
) -> None:
    run_id = submit(maker)
    assert delivered(maker) is not None
    upgraded()
    assert delivered(maker) is None
    run = run_of(maker, run_id)
    assert (run.state, run.attempt) == (State.FAILED, 1)
    assert (
        run.reason is not None
        and f"this is version {NEXT}" in run.reason
        and run.reason.endswith("Retry it to execute it again.")
    )
    with db.unit_of_work(maker) as session:
        again = RunService(session, MotionLibrary(None), FakeQueue()).retry(run_id, "Ana").id
    assert delivered(maker, "another turn") is not None
    assert run_of(maker, again).state is State.RUNNING


def test_a_run_that_a_version_without_this_column_started_is_torn_off_too(maker: sessionmaker[Session]) -> None:
    run_id = submit(maker)
    assert delivered(maker) is not None
    with db.unit_of_work(maker) as session:
        session.execute(sa.update(Run).values(started_version=None))
    assert delivered(maker) is None
    assert "was running in an earlier version of the program" in (run_of(maker, run_id).reason or "")


def test_a_run_whose_worker_died_without_a_change_of_version_starts_again(maker: sessionmaker[Session]) -> None:
    run_id = submit(maker)
    assert delivered(maker) is not None and delivered(maker) is not None
    assert (run_of(maker, run_id).state, run_of(maker, run_id).attempt) == (State.RUNNING, 2)


def test_a_test_on_a_physical_rig_is_not_repeated_by_itself(maker: sessionmaker[Session]) -> None:
    run_id = submit(maker)
    with db.unit_of_work(maker) as session:
        session.add(Rig(id="shaker", name="Shaker", kind="physical", tests_at_a_time=1, actuators=[]))
        session.execute(sa.update(Run).values(rig_id="shaker"))
    assert delivered(maker) is not None and delivered(maker) is None
    run = run_of(maker, run_id)
    assert (run.state, run.attempt) == (State.FAILED, 1)
    assert run.reason == (
        "The worker or the process of the test died. The test was on the rig Shaker. Inspect the rig, then retry."
    )


def test_a_sweep_that_a_change_of_version_tore_off_resumes_when_asked(client: TestClient, upgraded: Any) -> None:
    distribution = {"kind": "uniform", "lower": 20, "upper": 40}
    fields = [{"path": "stations.*.compensator.alpha_es", "distribution": distribution}]
    sweep = {"plan": plan(), "method": "latin_hypercube", "samples": 3, "fields": fields}
    sweep_id = client.post("/api/v1/sweeps", json={"sweep": sweep}).json()["id"]
    maker = app_of(client).state.sessions
    with db.unit_of_work(maker) as session:
        shards = list(session.scalars(sa.select(SweepShard.id)))

    def deliver() -> None:
        for shard in shards:
            with db.unit_of_work(maker) as session:
                JobService(session, SHARDS).start(shard, "lab-1")

    deliver()
    upgraded()
    deliver()
    with db.unit_of_work(maker) as session:
        reasons = set(session.scalars(sa.select(SweepShard.reason)))
    assert len(reasons) == 1 and "Resume the sweep" in str(reasons)
    assert client.get(f"/api/v1/sweeps/{sweep_id}").json()["state"] == "failed"
    assert client.post(f"/api/v1/sweeps/{sweep_id}/resume", json={}).status_code == 200


def test_the_queue_delivers_only_to_the_version_that_is_stored_with_a_turn(settings: Settings) -> None:
    """The reason why VERSION is pinned: another value strands whatever waits."""
    engine = db.connect(settings.url)
    queue = DurableQueue(engine)
    with db.unit_of_work(db.sessions(engine)) as session:
        queue.enqueue(session, RUNS, ["one"])
    system = queue.client._sys_db
    tests = DbosQueue.__new__(DbosQueue)
    vars(tests).update(name=RUNS.queue, **dict.fromkeys(LIMITS))
    assert VERSION == "1"
    assert system.start_queued_workflows(tests, "lab-1", "2", None) == ([], None)
    assert system.start_queued_workflows(tests, "lab-1", VERSION, None) == (["one"], None)
    queue.close()
    engine.dispose()


LIMITS = (
    "_concurrency",
    "_worker_concurrency",
    "_limiter",
    "_partition_concurrency",
    "_partition_worker_concurrency",
    "_partition_limiter",
)


def test_a_queue_is_registered_and_not_constructed() -> None:
    with pytest.raises(DBOSException, match="register_queue"):
        DbosQueue("tests")
