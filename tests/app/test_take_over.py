"""Who takes over what a dead worker holds, and when: kills before the first heartbeat, equal names, and clocks that jump."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.jobs import workers as beats_of
from app.jobs.queue import DurableQueue
from app.jobs.tables import WorkerHeartbeat
from app.jobs.workers import KEPT, SILENT_LOOKS, WORKER_SILENCE, Watch, Workers
from app.worker import peers as module
from app.worker.peers import LONGEST_NAME, Peers, unique
from rths_engine.foundation.errors import RthsError

HOUR = timedelta(hours=1)


class Turns:
    """Stands in for the durable queue: which worker holds which turns."""

    def __init__(self) -> None:
        self.held: dict[str, list[str]] = {}
        self.queued: list[str] = []

    def list_workflows(self, **_: Any) -> list[Any]:
        class Held:
            def __init__(self, executor_id: str):
                self.executor_id = executor_id

        return [Held(name) for name, turns in self.held.items() if turns]

    def _recover_pending_workflows(self, workers: list[str]) -> None:
        for worker in workers:
            self.queued += self.held.pop(worker, [])


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    engine = db.connect(settings.url)
    yield db.sessions(engine)
    engine.dispose()


@pytest.fixture
def turns(monkeypatch: pytest.MonkeyPatch) -> Turns:
    turns = Turns()
    monkeypatch.setattr(module, "DBOS", turns)
    return turns


def peer(maker: sessionmaker[Session], name: str) -> Peers:
    return Peers(maker, name, 2)


def clock(monkeypatch: pytest.MonkeyPatch, ahead: timedelta) -> None:
    """Set the clock of the database."""
    real = db.now
    monkeypatch.setattr(beats_of, "now", lambda session: real(session) + ahead)


def test_what_was_claimed_before_the_first_heartbeat_is_taken_over_at_once(maker: sessionmaker[Session], turns: Turns) -> None:
    turns.held["killed-1"] = ["A"]
    peer(maker, "living-1").look()
    assert turns.queued == ["A"]


def test_a_worker_tells_that_it_lives_before_it_serves_the_queue(maker: sessionmaker[Session], turns: Turns) -> None:
    first, second = peer(maker, "lab-1"), peer(maker, "lab-2")
    second.beat()
    turns.held["lab-2"] = ["A"]
    first.look()
    assert turns.queued == [] and turns.held == {"lab-2": ["A"]}


def test_two_starts_with_one_name_are_two_workers(maker: sessionmaker[Session], turns: Turns) -> None:
    first, second = unique("embedded"), unique("embedded")
    assert first != second and first.startswith("embedded-")
    turns.held[first] = ["A"]
    one, other = peer(maker, first), peer(maker, second)
    for _ in range(3 * SILENT_LOOKS):
        one.look()
        other.look()
    assert turns.queued == []


@pytest.mark.parametrize("name", ["", "  ", "x" * (LONGEST_NAME + 1)])
def test_a_name_that_is_blank_or_too_long_is_refused(name: str) -> None:
    with pytest.raises(RthsError, match="needs 1 to 60 characters"):
        unique(name)


def test_a_silent_worker_is_dead_after_six_looks_and_not_before(maker: sessionmaker[Session], turns: Turns) -> None:
    living, dying = peer(maker, "living-1"), peer(maker, "dying-1")
    dying.beat()
    turns.held["dying-1"] = ["A", "B"]
    for _ in range(SILENT_LOOKS):
        living.look()
    assert turns.queued == []
    living.look()
    assert turns.queued == ["A", "B"]


def test_a_worker_that_comes_back_is_seen_again_and_what_it_claims_then_is_its_own(
    maker: sessionmaker[Session], turns: Turns
) -> None:
    living, cut = peer(maker, "living-1"), peer(maker, "cut-1")
    cut.beat()
    for _ in range(2 * SILENT_LOOKS):
        living.look()
    cut.beat()
    turns.held["cut-1"] = ["A"]
    living.look()
    assert turns.queued == []


@pytest.mark.parametrize("jump", [3 * HOUR, -3 * HOUR])
def test_a_clock_that_jumps_kills_no_living_worker_and_keeps_no_dead_one(
    maker: sessionmaker[Session], turns: Turns, jump: timedelta, monkeypatch: pytest.MonkeyPatch
) -> None:
    living, other, dying = (peer(maker, name) for name in ("living-1", "other-1", "dying-1"))
    for one in (living, other, dying):
        one.look()
    clock(monkeypatch, jump)
    turns.held = {"other-1": ["A"], "dying-1": ["B"]}
    for _ in range(SILENT_LOOKS + 1):
        other.beat()
        living.look()
    assert turns.queued == ["B"] and turns.held == {"other-1": ["A"]}


@pytest.mark.parametrize("jump", [3 * HOUR, -3 * HOUR])
def test_people_see_who_lives_whatever_the_clock_did(
    maker: sessionmaker[Session], jump: timedelta, monkeypatch: pytest.MonkeyPatch
) -> None:
    peer(maker, "dead-1").beat()
    clock(monkeypatch, jump)
    with db.unit_of_work(maker) as session:
        workers = Workers(session)
        assert not workers.alive(workers.last_beat()) and workers.tests_at_a_time() == 0
    peer(maker, "living-1").beat()
    with db.unit_of_work(maker) as session:
        workers = Workers(session)
        assert workers.alive(workers.last_beat()) and workers.tests_at_a_time() == 2


def test_a_pause_of_the_observer_is_one_look() -> None:
    watch = Watch()
    beats = {"one": datetime.now(UTC)}
    for _ in range(SILENT_LOOKS):
        assert watch.look(beats) == set()
    assert watch.look({"one": beats["one"] + WORKER_SILENCE}) == set()


def test_a_worker_that_ends_is_taken_over_at_once_and_old_heartbeats_go(
    maker: sessionmaker[Session], turns: Turns, monkeypatch: pytest.MonkeyPatch
) -> None:
    living, ending, old = (peer(maker, name) for name in ("living-1", "ending-1", "old-1"))
    ending.beat()
    old.beat()
    turns.held["ending-1"] = ["A"]
    ending.leave()
    living.look()
    assert turns.queued == ["A"]
    clock(monkeypatch, 2 * KEPT)
    for _ in range(SILENT_LOOKS + 1):
        living.look()
    with db.unit_of_work(maker) as session:
        assert list(session.scalars(sa.select(WorkerHeartbeat.worker))) == ["living-1"]


def test_the_queue_gives_back_only_what_the_dead_worker_still_holds(settings: Settings) -> None:
    """What Peers relies on in DBOS: the turn goes back in one statement that names its holder."""
    engine = db.connect(settings.url)
    queue = DurableQueue(engine)
    system = queue.client._sys_db
    table = system.tables.workflow_status
    with system.engine.begin() as connection:
        for holder in ("dead", "living"):
            row = dict(workflow_uuid=holder, status="PENDING", executor_id=holder, queue_name="tests", name="run-test")
            connection.execute(sa.insert(table).values(**row))
    assert not system.reenqueue_for_recovery("living", ["dead"], "tests")
    assert system.reenqueue_for_recovery("dead", ["dead"], "tests")
    assert not system.reenqueue_for_recovery("dead", ["dead"], "tests")  # of two who see the death, one gives it back
    queue.close()
    engine.dispose()
