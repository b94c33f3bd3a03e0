"""Execution of one job of any kind: start it in the database, execute it in a process, store its result once."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session, sessionmaker

from app import logs
from app.config import Settings
from app.db import unit_of_work
from app.jobs.kind import Kind, Row
from app.jobs.order import Order
from app.jobs.service import JobService
from app.latch import Latch
from app.worker.child import CutOff, Done, Failed, Part, Progress
from app.worker.link import Links, Telling
from app.worker.patience import patiently
from app.worker.pool import JobProcess, Killed, Outcome, Pool, ProcessDied

log = logging.getLogger("rths.worker")
WAIT_POLL_S = 0.1
PROGRESS_S = 1.0  # between two writes of a job's progress
CUT_OFF = "its worker, which lost both the database and the web service"
AnyKind = Kind[Any, Any, Any]


@dataclass(slots=True)
class Running:
    """A job in its process, and the progress and the parts of its result that are not yet stored."""

    kind: AnyKind
    order: Order
    process: JobProcess
    telling: Telling | None
    progress: Progress | None = None
    written_at: float = -PROGRESS_S
    parts: list[Any] = field(default_factory=list)
    looked_at: float = -math.inf
    cut_off: bool = False
    storing: threading.Lock = field(default_factory=threading.Lock)

    def take(self, message: Any) -> None:
        """Take a message of the process: progress, a part, or one for viewers. Never waits: it is stored or sent later."""
        if isinstance(message, Progress):
            self.progress = message
        elif isinstance(message, Part):
            self.parts.append(message.result)
        elif isinstance(message, CutOff):
            self.cut_off = True
        elif self.telling is not None:
            self.telling.take(message)

    def news(self) -> Progress | None:
        """The progress to store now, or None; each progress is returned once."""
        now = time.monotonic()
        if self.progress is None or now - self.written_at < PROGRESS_S:
            return None
        news, self.progress, self.written_at = self.progress, None, now
        return news


class Executor:
    """Executes jobs in processes. `running` maps the ids of running jobs to these jobs.

    `holds` tells whether this worker still holds a delivery of the queue.
    """

    def __init__(
        self,
        settings: Settings,
        maker: sessionmaker[Session],
        link: Links,
        name: str,
        kinds: Sequence[AnyKind],
        latch: Latch | None = None,
        holds: Callable[[str], bool] = lambda delivery: True,
    ):
        self.settings, self.maker, self.link, self.name = settings, maker, link, name
        self.latch, self.holds = latch or Latch(), holds
        self.pools = {kind.name: Pool(kind, kind.at_a_time(settings)) for kind in kinds}
        self.running: dict[str, Running] = {}
        self._deliveries: list[tuple[str, AnyKind]] = []
        self._heard: set[tuple[str, int]] = set()
        self._lock = threading.Lock()

    def execute(self, kind: AnyKind, turn: str, delivery: str = "") -> None:
        """Execute a job to its end, and again if its process dies. `turn`: see JobService.start.

        `delivery` is the delivery of the turn, where it is not the first one: DurableQueue.
        """
        delivery = delivery or turn
        with self._busy_with(kind, delivery):
            while True:
                try:
                    return patiently(lambda: self._attempt(kind, turn, delivery))
                except ProcessDied as died:
                    log.warning("the process died (%s) over turn %s of %s", died, turn, kind.queue)

    def busy_with(self, kind: AnyKind) -> list[str]:
        """The deliveries of a kind that this worker executes, or that wait here for a process or for their start."""
        with self._lock:
            return [delivery for delivery, of in self._deliveries if of is kind]

    def executes(self, job_id: str) -> bool:
        """Whether a process of this worker executes a job, or its result is being stored."""
        with self._lock:
            return job_id in self.running

    def look(self) -> None:
        """Store the progress of running jobs, and stop the jobs that someone cancelled or that another worker took over."""
        with self._lock:
            running = list(self.running.values())
        for one in running:
            self._look(one)

    def stop_tests(self) -> list[str]:
        """Stop the running jobs that wait while the queue is held; the ids of those that are still executed. No database."""
        with self._lock:
            running = [one for one in self.running.values() if one.kind.waits_while_held]
        executed = [one for one in running if one.process.order is one.order]
        for one in executed:
            one.process.cancel(one.order)
        return [one.order.job_id for one in executed]

    def executing(self) -> list[dict[str, Any]]:
        """The jobs that run here, for a web service that is asked about them."""
        with self._lock:
            running = list(self.running.values())
        return [{"kind": one.kind.name, "id": one.order.job_id, "attempt": one.order.attempt} for one in running]

    def stop(self, job_id: str, attempt: int) -> None:
        """Stop an attempt that was cancelled or taken over, as a web service says. No database."""
        with self._lock:
            one = self.running.get(job_id)
        if one is not None and one.order.attempt == attempt:
            one.process.cancel(one.order)

    def assure(self, left_s: float) -> None:
        """Tell the processes of jobs that move machines that this worker is known to live for another `left_s`."""
        with self._lock:
            running = [one for one in self.running.values() if one.order.moves]
        for one in running:
            one.process.assure(one.order, left_s)

    def _keep(self, one: Running) -> None:
        """Store the parts that the process has sent, each once."""
        with one.storing:
            parts = one.parts[:]
            if parts:
                with unit_of_work(self.maker) as session:
                    JobService(session, one.kind).keep(one.order.job_id, one.order.attempt, parts)
                del one.parts[: len(parts)]

    def _look(self, one: Running) -> None:
        if time.monotonic() - one.looked_at < one.kind.polling_s:
            return
        one.looked_at = time.monotonic()
        self._keep(one)
        order, news = one.order, one.news()
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, one.kind)
            if news is not None:
                jobs.progress(order.job_id, order.attempt, news.doing, news.share)
            stop = jobs.to_stop(order.job_id, order.attempt)
        if stop:
            one.process.cancel(order)

    @contextmanager
    def _busy_with(self, kind: AnyKind, delivery: str) -> Iterator[None]:
        with self._lock:
            self._deliveries.append((delivery, kind))
        try:
            yield
        finally:
            with self._lock:
                self._deliveries.remove((delivery, kind))

    def _attempt(self, kind: AnyKind, turn: str, delivery: str) -> None:
        with unit_of_work(self.maker) as session:
            over = JobService(session, kind).over(turn)
        if over:
            self._start(kind, turn, delivery)  # removes files of earlier attempts and sends the end to viewers
            return
        pool = self.pools[kind.name]
        process = pool.take()
        try:
            order, waits = self._start(kind, turn, delivery)
            while waits:
                time.sleep(WAIT_POLL_S)
                if self._may_start(kind):
                    order, waits = self._start(kind, turn, delivery)
            if order is not None:
                self._execute(kind, order, process)
        finally:
            pool.give(process)

    def _aborted(self, kind: AnyKind) -> bool:
        return kind.waits_while_held and self.latch.held

    def _may_start(self, kind: AnyKind) -> bool:
        if self._aborted(kind):
            return False
        with unit_of_work(self.maker) as session:
            return JobService(session, kind).may_start()

    def _start(self, kind: AnyKind, turn: str, delivery: str) -> tuple[Order | None, bool]:
        """The order of the job that starts in this turn, and whether the turn waits instead.

        Nothing starts where another worker holds the delivery by now: it took this one for dead, which was cut off meanwhile.
        """
        if not self.holds(delivery):
            log.warning("another worker has taken over turn %s of %s", turn, kind.queue)
            return None, False
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, kind)
            taken = jobs.start(turn, self.name, self._aborted(kind), self._heard)
            for job in (taken.left, taken.started):
                if job is not None:
                    kind.clear(job, self.settings)
            left = taken.left
            if left is not None and left is not taken.started and kind.watched_live:
                self.link.open(left.id, left.attempt).ended = True
            order = self._order(jobs, taken.started) if taken.started is not None else None
        if order is not None:
            self._heard.add((order.job_id, order.attempt))
        return order, taken.waits

    def _order(self, jobs: JobService[Row, Any], job: Row) -> Order | None:
        """The order for a job that has started. One that has none fails alone: the jobs behind it go on."""
        kind = jobs.kind
        try:
            order: Order = kind.order(job, self.settings)
            return order
        except SQLAlchemyError:
            raise
        except Exception as error:
            log.exception("%s %s cannot be started", kind.name, job.id)
            jobs.fail(job.id, job.attempt, f"The {kind.noun} could not be started. {type(error).__name__}: {error}")
            if kind.watched_live:
                self.link.open(job.id, job.attempt).ended = True
            return None

    def _execute(self, kind: AnyKind, order: Order, process: JobProcess) -> None:
        telling = self.link.open(order.job_id, order.attempt) if kind.watched_live else None
        running = Running(kind, order, process, telling)
        with self._lock:
            self.running[order.job_id] = running
        try:
            try:
                with logs.about(run=order.job_id):
                    outcome = Killed() if self._aborted(kind) else process.execute(order, running.take)
            finally:
                patiently(lambda: self._keep(running))
            self._end(kind, order, outcome, CUT_OFF if running.cut_off else self.latch.by if kind.waits_while_held else None)
        finally:
            with self._lock:
                del self.running[order.job_id]
            kind.discard(order)
            if telling is not None:
                telling.ended = True

    def _end(self, kind: AnyKind, order: Order, outcome: Outcome, by: str | None) -> None:
        """Store the outcome of an attempt, rows and files together. While the database is away, the result waits here.

        `by`: who stopped it, where the database does not know it yet.
        """
        placed: list[Order] = []  # not empty once the files are in place: a commit that failed after it is done again alone
        try:
            patiently(lambda: self._store(kind, order, outcome, placed, by))
        except OSError as error:
            failed = Failed(f"The result of the {kind.noun} was not stored: {error.strerror or error}.")
            patiently(lambda: self._store(kind, order, failed, placed, by))
        self._heard.discard((order.job_id, order.attempt))

    def _store(self, kind: AnyKind, order: Order, outcome: Outcome, placed: list[Order], by: str | None) -> None:
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, kind)
            if by is not None:
                jobs.asked_to_stop(order.job_id, order.attempt, by)
            if isinstance(outcome, Done):
                if jobs.finish(order.job_id, order.attempt, outcome.result):
                    session.flush()
                    if not placed:
                        kind.place(order, self.settings)
                        placed.append(order)
            elif isinstance(outcome, Failed):
                jobs.fail(order.job_id, order.attempt, outcome.reason, outcome.stopped)
            else:
                jobs.stop(order.job_id, order.attempt)
