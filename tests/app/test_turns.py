"""Which run a turn of the durable queue starts: by priority and position, one test on a rig, each run once after a kill."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.events.tables import Event
from app.jobs.hold import Hold
from app.jobs.service import JobService, Taken
from app.jobs.states import State
from app.models import Rig, Run
from app.runs.job import RUNS
from app.runs.order import Outcome
from app.runs.service import RunService
from rths_engine.parts.ground_motions import MotionLibrary
from tests.app.conftest import plan
from tests.app.test_run_states import SUMMARY, FakeQueue

SHAKER = "shaker"


class Laboratory:
    """A database with runs named by a letter, and workers that are nothing but their turns."""

    def __init__(self, maker: sessionmaker[Session]):
        self.maker = maker

    def submit(self, names: str) -> None:
        with db.unit_of_work(self.maker) as session:
            RunService(session, MotionLibrary(None), FakeQueue()).submit([plan(name=name) for name in names], "Ana")

    def change(self, names: str, **values: object) -> None:
        with db.unit_of_work(self.maker) as session:
            for run in session.scalars(sa.select(Run).where(Run.name.in_([*names]))):
                for name, value in values.items():
                    setattr(run, name, value)

    def take(self, turn: str, worker: str = "one") -> Taken[Run]:
        with db.unit_of_work(self.maker) as session:
            return JobService(session, RUNS).start(turn, worker)

    def started(self, turn: str) -> str:
        started = self.take(turn).started
        return started.name if started else ""

    def end(self, name: str) -> None:
        run = self.run(name)
        with db.unit_of_work(self.maker) as session:
            assert JobService(session, RUNS).finish(run.id, run.attempt, Outcome(SUMMARY, "0" * 64, 1))

    def run(self, name: str) -> Run:
        with db.unit_of_work(self.maker) as session:
            return session.scalars(sa.select(Run).where(Run.name == name)).one()

    def starts(self) -> str:
        with db.unit_of_work(self.maker) as session:
            return "".join(session.scalars(sa.select(Event.name).where(Event.kind == "started").order_by(Event.number)))


@pytest.fixture
def lab(settings: Settings) -> Iterator[Laboratory]:
    engine = db.connect(settings.url)
    yield Laboratory(db.sessions(engine))
    engine.dispose()


def test_runs_start_by_priority_and_then_by_position(lab: Laboratory) -> None:
    lab.submit("ABCDE")
    lab.change("E", priority=1)
    lab.change("D", position=1.5)  # between A and B
    assert [lab.started(f"turn {k}") for k in range(6)] == ["E", "A", "D", "B", "C", ""]
    assert [lab.run(name).beside for name in "EADBC"] == [0, 1, 2, 3, 4]


def test_a_run_waits_for_its_physical_rig_and_others_pass_it(lab: Laboratory) -> None:
    lab.submit("ABCD")
    with db.unit_of_work(lab.maker) as session:
        session.add(Rig(id=SHAKER, name="Shaker", kind="physical", tests_at_a_time=1, actuators=[]))
    lab.change("DAB", rig_id=SHAKER)
    assert [lab.started(turn) for turn in ("1", "2")] == ["A", "C"]
    waiting = lab.take("3")
    assert waiting.started is None and waiting.waits
    lab.end("C")
    assert lab.take("3").waits
    lab.end("A")
    assert lab.started("3") == "B"
    assert lab.take("4").waits
    lab.end("B")
    assert [lab.started("4"), lab.take("5").waits] == ["D", False]


def test_a_killed_worker_leaves_its_run_to_its_turn_and_the_order_stays(lab: Laboratory) -> None:
    lab.submit("ABCD")
    assert [lab.started("1"), lab.started("2")] == ["A", "B"]
    lab.end("B")
    again = lab.take("1", "two")  # worker one died; its turn is delivered to worker two
    assert again.started is not None and (again.started.name, again.started.attempt, again.started.worker) == ("A", 2, "two")
    lab.end("A")
    assert lab.take("1").started is None  # delivered once more: its run has ended
    assert lab.take("1").waits is False
    assert [lab.started("3"), lab.started("4"), lab.started("5")] == ["C", "D", ""]
    assert lab.starts() == "ABACD"


def test_a_run_left_while_the_queue_is_held_waits_at_its_place(lab: Laboratory) -> None:
    lab.submit("AB")
    assert lab.started("1") == "A"
    with db.unit_of_work(lab.maker) as session:
        Hold(session).set("Ana", "oil leak")
    left = lab.take("1")
    assert left.waits and left.left is not None and left.left.name == "A"
    assert (lab.run("A").state, lab.run("A").turn) == (State.QUEUED, None)
    with db.unit_of_work(lab.maker) as session:
        Hold(session).release("Ana")
    assert [lab.started("2"), lab.started("1")] == ["A", "B"]
    assert lab.run("A").attempt == 2
