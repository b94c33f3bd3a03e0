"""A kind of job that the service does not know: declared in one file, it has all that runs and diagnoses have."""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings, from_environment
from app.jobs import queue as durable
from app.jobs.hold import Hold
from app.jobs.kind import Kind
from app.jobs.service import MOST_ATTEMPTS, JobService
from app.jobs.states import IllegalTransition, State
from app.worker.kinds import KINDS
from tests.app.third_kind import COUNTS, DIES, REFUSED, Count, Other
from tests.browser.service import DATABASE_URL, ROOT, UNMEASURED, until

LONG = 100_000
PATIENCE_S = 60  # two busy cores; a dead worker is noticed after 6 s


class Counts:
    """The counts as people ask for them, and workers that execute them."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], queue: durable.DurableQueue):
        self.settings, self.maker, self.queue = settings, maker, queue

    def submit(self, wanted: int) -> str:
        with db.unit_of_work(self.maker) as session:
            count = Count(wanted=wanted)
            JobService(session, COUNTS, self.queue).submit([count], "Ana")
            return count.id

    def cancel(self, count: str) -> None:
        with db.unit_of_work(self.maker) as session:
            JobService(session, COUNTS).cancel(count, "Bo")

    def get(self, count: str) -> Count:
        with db.unit_of_work(self.maker) as session:
            return JobService(session, COUNTS).get(count)

    def ended(self, count: str) -> Count:
        found: Count = until(lambda: self.get(count), lambda one: one.state.ended, PATIENCE_S)
        return found

    def under_way(self, count: str) -> Count:
        found: Count = until(lambda: self.get(count), lambda one: one.share > 0, PATIENCE_S)
        return found

    @contextmanager
    def worker(self, name: str) -> Iterator[subprocess.Popen[bytes]]:
        command = [sys.executable, "-m", "tests.app.third_kind", str(self.settings.data), name]
        process = subprocess.Popen(command, cwd=ROOT, env=UNMEASURED)
        try:
            yield process
        finally:
            process.kill()
            process.wait()


@contextmanager
def counts_in(data: Path) -> Iterator[Counts]:
    settings = from_environment(data=data, database_url=DATABASE_URL).prepared()
    db.migrate(settings.url)
    durable.migrate(settings.url)
    engine = db.connect(settings.url)
    Other.metadata.create_all(engine)
    queue = durable.DurableQueue(engine)
    yield Counts(settings, db.sessions(engine), queue)
    queue.close()
    engine.dispose()


@pytest.fixture(scope="module")
def worked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Counts]:
    with counts_in(tmp_path_factory.mktemp("counts")) as counts, counts.worker("first"):
        yield counts


def test_another_worker_takes_it_over_when_its_worker_was_killed(tmp_path: Path) -> None:
    with counts_in(tmp_path) as counts:
        with counts.worker("doomed") as doomed:
            count = counts.submit(300)
            counts.under_way(count)
            os.kill(doomed.pid, signal.SIGKILL)
        with counts.worker("second"):
            found = counts.ended(count)
    assert (found.state, found.attempt, found.worker, found.counted) == (State.COMPLETED, 2, "second", 300)


def test_it_runs_to_its_end_and_its_result_is_stored(worked: Counts) -> None:
    count = worked.ended(worked.submit(5))
    assert (count.state, count.counted, count.reason) == (State.COMPLETED, 5, "Counted to 5.")
    assert (count.attempt, count.worker, count.share, count.doing) == (1, "first", 1.0, "")


def test_it_is_cancelled_while_it_waits_and_while_it_runs(worked: Counts) -> None:
    running = worked.submit(LONG)
    assert worked.under_way(running).doing.startswith("at ")
    waiting = worked.submit(1)  # one at a time
    worked.cancel(waiting)
    assert worked.get(waiting).reason == "Cancelled by Bo before it started."
    worked.cancel(running)
    count = worked.ended(running)
    assert (count.state, count.reason) == (State.CANCELLED, "Cancelled by Bo. No result was stored.")
    assert count.counted is None and count.doing == ""
    with pytest.raises(IllegalTransition, match="The count has already ended: it is cancelled and cannot become cancelled"):
        worked.cancel(running)


def test_it_is_tried_again_when_its_process_dies_and_fails_after_three_attempts(worked: Counts) -> None:
    count = worked.ended(worked.submit(DIES))
    assert (count.state, count.attempt) == (State.FAILED, MOST_ATTEMPTS)
    assert count.reason == "The worker or the process of the count died 3 times. There is no further attempt."


def test_it_fails_at_once_with_the_reason_when_it_is_refused(worked: Counts) -> None:
    count = worked.ended(worked.submit(REFUSED))
    assert (count.state, count.attempt, count.reason) == (State.FAILED, 1, "Nobody counts to -1.")


def test_it_does_not_wait_while_the_queue_is_held_unless_it_is_declared_so(worked: Counts) -> None:
    with db.unit_of_work(worked.maker) as session:
        Hold(session).set("Bo")
    try:
        assert worked.ended(worked.submit(1)).state is State.COMPLETED
    finally:
        with db.unit_of_work(worked.maker) as session:
            Hold(session).release("Bo")


@pytest.mark.parametrize("kind", [*KINDS, COUNTS], ids=lambda kind: kind.name)
def test_every_kind_declares_a_process_that_exists(kind: Kind[Any, Any, Any]) -> None:
    module = importlib.import_module(kind.process)
    assert callable(module.prepare) and callable(module.execute)


def test_no_two_kinds_share_a_name_a_table_a_queue_or_a_workflow() -> None:
    for names in zip(*((kind.name, kind.table, kind.queue, kind.workflow) for kind in KINDS), strict=True):
        assert len(set(names)) == len(names)
