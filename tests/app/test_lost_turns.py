"""The net under the durable queue: deliveries that DBOS lost, and jobs that nobody executes, are queued again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.jobs.kind import Kind
from app.jobs.queue import DurableQueue
from app.jobs.service import JobService
from app.jobs.states import State
from app.models import Run, Sweep, SweepPart, SweepShard
from app.runs.job import RUNS
from app.runs.service import RunService
from app.sweeps.job import SHARDS
from app.sweeps.order import ShardPart
from app.worker import lost as module
from app.worker import patience
from app.worker.lost import CLAIM_LOOKS, LOOKS, Lost
from rths_engine.parts.ground_motions import MotionLibrary
from tests.app.conftest import plan

LIVING = {"here-1", "there-1"}


class Worker:
    """Stands in for the executor: the deliveries and jobs that it says to be busy with."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], name: str):
        self.settings, self.maker, self.name = settings, maker, name
        self.deliveries: list[str] = []
        self.jobs: set[str] = set()

    def busy_with(self, kind: Kind[Any, Any, Any]) -> list[str]:
        return self.deliveries

    def executes(self, job_id: str) -> bool:
        return job_id in self.jobs


class Bench:
    """A database with the durable queue, the nets of two workers, and what the tests do to the queue."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], queue: DurableQueue):
        self.maker, self.queue = maker, queue
        self.worker, self.other = (Worker(settings, maker, name) for name in ("here-1", "there-1"))
        self.nets = [Lost(one, queue, [RUNS, SHARDS]) for one in (self.worker, self.other)]  # type: ignore[arg-type]

    def run(self) -> str:
        with db.unit_of_work(self.maker) as session:
            return RunService(session, MotionLibrary(None), self.queue).submit([plan()], "Ana Ruiz")[0].id

    def shard(self) -> str:
        with db.unit_of_work(self.maker) as session:
            about = dict(id="sweep", name="s", definition={}, columns=[], method="grid", points=6, cost="", code_version="1")
            sweep = Sweep(**about, submitted_by="Ana", submitted_at=db.now(session))
            session.add(sweep)
            session.flush()
            shard = SweepShard(sweep_number=sweep.number, first=0, count=6)
            JobService(session, SHARDS, self.queue).submit([shard], "Ana")
            return shard.id

    def change(self, delivery: str, status: str, worker: str | None = None) -> None:
        """Change a delivery in the records of DBOS."""
        system = self.queue.client._sys_db
        table = system.tables.workflow_status
        with system.engine.begin() as connection:
            changed = sa.update(table).where(table.c.workflow_uuid == delivery)
            connection.execute(changed.values(status=status, executor_id=worker))

    def start(self, turn: str, worker: str, kind: Kind[Any, Any, Any] = RUNS) -> Any:
        with db.unit_of_work(self.maker) as session:
            return JobService(session, kind).start(turn, worker).started

    def waiting(self) -> list[str]:
        found = self.queue.client.list_workflows(status="ENQUEUED", load_input=True)
        assert all(one.input is not None for one in found)
        return sorted(one.workflow_id for one in found)

    def look(self, times: int = LOOKS, living: set[str] = LIVING) -> list[str]:
        """Both workers look; returns the deliveries that wait then."""
        for _ in range(times):
            for net in self.nets:
                net.look(living)
        return self.waiting()


@pytest.fixture
def bench(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    monkeypatch.setattr(module, "LOOK_S", 0.0)
    engine = db.connect(settings.url)
    queue = DurableQueue(engine)
    yield Bench(settings, db.sessions(engine), queue)
    queue.close()
    engine.dispose()


@pytest.mark.parametrize("ended", ["ERROR", "SUCCESS", "CANCELLED"])
def test_a_queued_test_whose_turn_has_ended_gets_one_new_turn(bench: Bench, ended: str) -> None:
    run = bench.run()
    bench.change(run, ended)
    assert bench.look(LOOKS - 1) == []
    (turn,) = bench.look(3 * LOOKS)
    assert bench.start(turn, "here-1").id == run


def test_queued_tests_that_have_turns_get_no_others(bench: Bench) -> None:
    waits, taken = bench.run(), bench.run()
    bench.change(taken, "PENDING", "there-1")
    bench.other.deliveries = [taken]
    assert bench.look(3 * LOOKS) == [waits]
    bench.change(waits, "PENDING", "there-1")
    bench.other.deliveries = [taken, waits]  # both wait in that worker for their start
    assert bench.look(3 * LOOKS) == []


def test_a_worker_without_a_free_place_queues_nothing(bench: Bench) -> None:
    bench.change(bench.run(), "ERROR")
    bench.nets = bench.nets[:1]
    bench.worker.deliveries = ["another"] * RUNS.at_a_time(bench.worker.settings)
    assert bench.look(3 * LOOKS) == []


@pytest.mark.parametrize("kind", [RUNS, SHARDS])
def test_a_running_job_of_a_dead_worker_without_a_turn_is_delivered_again(bench: Bench, kind: Kind[Any, Any, Any]) -> None:
    job = bench.run() if kind is RUNS else bench.shard()
    bench.start(job, "gone-1", kind)
    bench.change(job, "ERROR")
    assert bench.look(LOOKS - 1) == []
    assert bench.look(3 * LOOKS) == [f"{job}/1"]
    assert bench.start(job, "here-1", kind).attempt == 2
    bench.change(f"{job}/1", "ERROR")
    assert bench.look(3 * LOOKS, {"there-1"}) == [f"{job}/2"]


def test_a_running_job_of_this_worker_that_it_does_not_execute_is_delivered_again(bench: Bench) -> None:
    run = bench.run()
    bench.start(run, "here-1")
    bench.change(run, "SUCCESS")
    bench.worker.jobs = {run}
    assert bench.look(3 * LOOKS) == []
    bench.worker.jobs = set()
    assert bench.look(LOOKS) == [f"{run}/1"]


def test_what_a_living_worker_executes_or_a_take_over_delivers_is_left_alone(bench: Bench) -> None:
    executed, taken = bench.run(), bench.run()
    bench.start(executed, "there-1")
    bench.change(executed, "PENDING", "there-1")
    bench.other.jobs, bench.other.deliveries = {executed}, [executed]
    bench.start(taken, "gone-1")
    assert bench.look(3 * CLAIM_LOOKS) == [taken]


def test_a_queued_shard_without_a_delivery_gets_one(bench: Bench) -> None:
    shard = bench.shard()
    bench.change(shard, "ERROR")
    assert bench.look(3 * LOOKS) == [f"{shard}/1"]
    assert bench.start(shard, "here-1", SHARDS).id == shard


def test_a_delivery_that_a_worker_claimed_without_knowing_it_goes_back(bench: Bench) -> None:
    run = bench.run()
    bench.change(run, "PENDING", "here-1")
    bench.worker.deliveries = [run]
    assert bench.look(3 * CLAIM_LOOKS) == []
    bench.worker.deliveries = []
    assert bench.look(CLAIM_LOOKS - 1) == []
    assert bench.look(1) == [run]


def test_a_part_of_a_sweep_whose_commit_got_no_answer_is_stored_once(bench: Bench) -> None:
    shard = bench.shard()
    bench.start(shard, "here-1", SHARDS)
    part = ShardPart(0, 2, b"0" * 16, {}, 0, 0, 0, 0.1, 1.0)
    for parts in ([part], [part, ShardPart(2, 1, b"1" * 8, {}, 0, 0, 0, 0.1, 1.0)]):
        with db.unit_of_work(bench.maker) as session:
            JobService(session, SHARDS).keep(shard, 1, parts)
    with bench.maker() as session:
        assert [(one.first, one.count) for one in session.scalars(sa.select(SweepPart).order_by(SweepPart.first))] == [
            (0, 2),
            (2, 1),
        ]


def test_the_queue_goes_on_soon_after_an_outage_however_long_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pauses: list[float] = []

    def sleep(pause: float) -> None:
        pauses.append(pause)
        if len(pauses) == 30:
            (tmp_path / "back").mkdir()

    monkeypatch.setattr("app.worker.patience.time.sleep", sleep)
    engine = patience.patient_engine(f"sqlite:///{tmp_path / 'back' / 'queue.sqlite'}")
    with engine.connect() as connection:
        assert connection.scalar(sa.text("pragma busy_timeout")) == patience.BUSY_TIMEOUT_MS
    assert len(pauses) == 30 and max(pauses) == 2.0
    engine.dispose()


def test_a_test_of_a_run_row_without_a_turn_is_still_found(bench: Bench) -> None:
    """Rows of earlier versions of the program have no turn; their delivery has the id of the run."""
    run = bench.run()
    bench.start(run, "gone-1")
    with db.unit_of_work(bench.maker) as session:
        found = session.scalars(sa.select(Run).where(Run.id == run)).one()
        found.turn = None
        assert found.state is State.RUNNING
    assert bench.look(3 * LOOKS) == [run]
