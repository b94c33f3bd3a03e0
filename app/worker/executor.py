"""Execution of one job of any kind: start it in the database, execute it in a process, store its result once."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings
from app.db import unit_of_work
from app.jobs.hold import Hold
from app.jobs.kind import Kind
from app.jobs.order import Order
from app.jobs.service import JobService
from app.worker.child import Done, Failed, Progress
from app.worker.link import Link, Telling
from app.worker.pool import JobProcess, Outcome, Pool, ProcessDied

log = logging.getLogger("rths.worker")
HOLD_POLL_S = 0.1
PROGRESS_S = 1.0  # between two writes of a job's progress
AnyKind = Kind[Any, Any, Any]


@dataclass(slots=True)
class Running:
    """A job in its process, and the progress that is not yet stored."""

    kind: AnyKind
    order: Order
    process: JobProcess
    telling: Telling | None
    progress: Progress | None = None
    written_at: float = -PROGRESS_S

    def take(self, message: Any) -> None:
        """Take a message of the process, progress or a message for viewers. Never waits: it is stored or sent later."""
        if isinstance(message, Progress):
            self.progress = message
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
    """Executes jobs in processes. `running` maps the ids of running jobs to these jobs."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], link: Link, name: str, kinds: Sequence[AnyKind]):
        self.settings, self.maker, self.link, self.name = settings, maker, link, name
        self.pools = {kind.name: Pool(kind, kind.at_a_time(settings)) for kind in kinds}
        self.running: dict[str, Running] = {}
        self._lock = threading.Lock()

    def execute(self, kind: AnyKind, job_id: str) -> None:
        """Execute a job to its end, and again if its process dies. A job that has ended or was cancelled is not executed."""
        try:
            self._attempt(kind, job_id)
        except ProcessDied as died:
            log.warning("the process died (%s) over %s %s", died, kind.name, job_id)
            self.execute(kind, job_id)

    def look(self) -> None:
        """Store the progress of running jobs, and stop the jobs that someone cancelled."""
        with self._lock:
            running = list(self.running.values())
        for one in running:
            self._look(one)

    def _look(self, one: Running) -> None:
        order, news = one.order, one.news()
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, one.kind)
            if news is not None:
                jobs.progress(order.job_id, order.attempt, news.doing, news.share)
            cancelled = jobs.cancel_requested(order.job_id)
        if cancelled:
            one.process.cancel()

    def _attempt(self, kind: AnyKind, job_id: str) -> None:
        if self._ended(kind, job_id):
            self._start(kind, job_id)  # removes files of earlier attempts and sends the end to viewers
            return
        pool = self.pools[kind.name]
        process = pool.take()
        try:
            if kind.waits_while_held:
                self._wait_while_held()
            order = self._start(kind, job_id)
            if order is not None:
                self._execute(kind, order, process)
        finally:
            pool.give(process)

    def _ended(self, kind: AnyKind, job_id: str) -> bool:
        with unit_of_work(self.maker) as session:
            job = JobService(session, kind).rows.get(job_id)
            return job is None or job.state.ended

    def _wait_while_held(self) -> None:
        while True:
            with unit_of_work(self.maker) as session:
                if not Hold(session).held:
                    return
            time.sleep(HOLD_POLL_S)

    def _start(self, kind: AnyKind, job_id: str) -> Order | None:
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, kind)
            started = jobs.start(job_id, self.name)
            job = started or jobs.rows.get(job_id)
            if job is None:
                return None
            kind.clear(job, self.settings)
            if started is None:
                if kind.watched_live:
                    self.link.open(job_id, job.attempt).ended = True
                return None
            order: Order = kind.order(job, self.settings)
            return order

    def _execute(self, kind: AnyKind, order: Order, process: JobProcess) -> None:
        telling = self.link.open(order.job_id, order.attempt) if kind.watched_live else None
        running = Running(kind, order, process, telling)
        with self._lock:
            self.running[order.job_id] = running
        try:
            self._end(kind, order, process.execute(order, running.take))
        except OSError as error:
            self._end(kind, order, Failed(f"The result of the {kind.noun} was not stored: {error.strerror or error}."))
        finally:
            with self._lock:
                del self.running[order.job_id]
            kind.discard(order)
            if telling is not None:
                telling.ended = True

    def _end(self, kind: AnyKind, order: Order, outcome: Outcome) -> None:
        """Store the outcome of an attempt: rows and files together; if either fails, the next attempt redoes both."""
        with unit_of_work(self.maker) as session:
            jobs = JobService(session, kind)
            if isinstance(outcome, Done):
                if jobs.finish(order.job_id, order.attempt, outcome.result):
                    session.flush()
                    kind.place(order, self.settings)
            elif isinstance(outcome, Failed):
                jobs.fail(order.job_id, order.attempt, outcome.reason)
            else:
                jobs.stop(order.job_id, order.attempt)
