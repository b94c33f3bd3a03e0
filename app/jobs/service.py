"""Rules of jobs of every kind: submit, start, cancel, end and take over. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any, Generic, Protocol

from sqlalchemy.orm import Session

from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs import states
from app.jobs.hold import Hold
from app.jobs.kind import Kind, Result, Row
from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.problems import Conflict, NotFound

MOST_ATTEMPTS = 3
NOBODY = "unnamed"


class Queue(Protocol):
    """The part of the durable queue that submitting uses."""

    def enqueue(self, session: Session, kind: Kind[Any, Any, Any], ids: Sequence[str]) -> None: ...


class JobService(Generic[Row, Result]):
    """Rules of the jobs of one kind. Every change of a job's state goes through this class and TRANSITIONS."""

    def __init__(self, session: Session, kind: Kind[Row, Any, Result], queue: Queue | None = None):
        table: Any = kind.table
        self.rows: JobRepository[Row] = JobRepository(session, table)
        self.session, self.kind, self.queue = session, kind, queue

    def submit(self, jobs: Sequence[Row], by: str) -> None:
        """Store and queue jobs, all in the transaction of the session."""
        for job in jobs:
            job.id, job.state, job.attempt = str(uuid.uuid4()), State.QUEUED, 0
            job.submitted_by, job.submitted_at = named(by), datetime.now(UTC)
        self.rows.add(jobs)
        assert self.queue is not None
        self.queue.enqueue(self.session, self.kind, [job.id for job in jobs])

    def get(self, job_id: str) -> Row:
        """The job with this id. Raises NotFound."""
        job = self.rows.get(job_id)
        if job is None:
            raise NotFound(f"There is no {self.kind.name} {job_id}.")
        return job

    def locked(self, job_id: str) -> Row:
        """The job as it is now, locked until the end of the transaction. Raises NotFound."""
        return self.rows.locked(job_id) or self.get(job_id)

    def cancel(self, job_id: str, by: str) -> Row:
        """Cancel a queued job now; ask the worker to stop a running job. Raises IllegalTransition for a job that has ended."""
        job = self.locked(job_id)
        states.check(job.state, State.CANCELLED, self.kind.noun)
        if job.state is State.QUEUED:
            self._end(job, State.CANCELLED, f"Cancelled by {named(by)} before it started.")
        else:
            job.cancel_requested_by = named(by)
        return job

    def cancel_running(self, by: str) -> list[Row]:
        """Ask the workers to stop every running job; returns these jobs."""
        stopping = []
        for job_id in self.rows.ids(State.RUNNING):
            job = self.rows.locked(job_id)
            if job is not None and job.state is State.RUNNING:
                job.cancel_requested_by = named(by)
                stopping.append(job)
        return stopping

    def remove(self, job_id: str) -> None:
        """Delete a job that has ended. Raises Conflict for a job that has not."""
        job = self.locked(job_id)
        if not job.state.ended:
            raise Conflict(f"The {self.kind.noun} has not ended: it is {job.state}. Cancel it first.")
        self.rows.remove(job)

    def start(self, job_id: str, worker: str) -> Row | None:
        """Start a job on a worker. None if there is nothing to do: the job has ended, was cancelled, or has no attempt left.

        A running job was left by a worker that died; this worker takes it over. For a kind with `waits_while_held` the worker
        has already waited for the release of the queue. If the queue is held again at this moment, the job ends as cancelled.
        """
        queue = Hold(self.session).locked() if self.kind.waits_while_held else None
        job = self.rows.locked(job_id)
        if job is None or job.state.ended:
            return None
        noun = self.kind.noun
        if job.state is State.RUNNING:
            self._move(job, State.QUEUED)
        if job.cancel_requested_by:
            died = f"The worker or the process of the {noun} had died."
            self._end(job, State.CANCELLED, f"Cancelled by {job.cancel_requested_by}. {died}")
        elif queue is not None and queue.held:
            self._end(job, State.CANCELLED, f"Stopped by {queue.held_by} before it started.")
        elif job.attempt >= MOST_ATTEMPTS:
            died = f"The worker or the process of the {noun} died {job.attempt} times"
            self._end(job, State.FAILED, f"{died}. There is no further attempt.")
        else:
            self._move(job, State.RUNNING)
            job.attempt += 1
            job.worker, job.started_at, job.doing, job.share = worker, datetime.now(UTC), "", 0.0
            again = f", attempt {job.attempt}" if job.attempt > 1 else ""
            self._tell(EventKind.STARTED, job, f"Started on worker {worker}{again}.")
            return job
        return None

    def progress(self, job_id: str, attempt: int, doing: str, share: float) -> None:
        """Store the progress of an attempt; nothing happens if the attempt is not the current one."""
        self.rows.progress(job_id, attempt, doing, share)

    def cancel_requested(self, job_id: str) -> bool:
        """Whether someone asked to cancel a running job."""
        return self.rows.cancel_requested(job_id)

    def finish(self, job_id: str, attempt: int, result: Result) -> bool:
        """Store the result of an attempt. False if it is not stored: the job has ended, is cancelled or was taken over."""
        job = self._current(job_id, attempt)
        if job is None:
            return False
        if job.cancel_requested_by and not self.kind.keeps_when_cancelled:
            self._cancelled(job)
            return False
        state, reason = self.kind.store(job, result)
        if state is State.COMPLETED:
            job.share = 1.0
        self._end(job, state, reason)
        return True

    def fail(self, job_id: str, attempt: int, reason: str) -> None:
        """End a job whose attempt failed, unless it has ended or was taken over."""
        job = self._current(job_id, attempt)
        if job is not None:
            self._end(job, State.FAILED, reason)

    def stop(self, job_id: str, attempt: int) -> None:
        """End a job whose process was killed because someone cancelled it."""
        job = self._current(job_id, attempt)
        if job is not None:
            self._cancelled(job)

    def _current(self, job_id: str, attempt: int) -> Row | None:
        job = self.rows.locked(job_id)
        return job if job is not None and job.attempt == attempt and not job.state.ended else None

    def _cancelled(self, job: Row) -> None:
        self._end(job, State.CANCELLED, f"Cancelled by {job.cancel_requested_by}. No result was stored.")

    def _move(self, job: Row, state: State) -> None:
        states.check(job.state, state, self.kind.noun)
        job.state = state

    def _end(self, job: Row, state: State, reason: str) -> None:
        self._move(job, state)
        job.reason, job.finished_at, job.doing = reason, datetime.now(UTC), ""
        self._tell(EventKind(state), job, reason)

    def _tell(self, kind: EventKind, job: Row, sentence: str) -> None:
        title = self.kind.title(job)
        called = f"{self.kind.name.capitalize()} {job.number}{', ' if title else ''}{title}"
        EventLog(self.session).add(kind, f"{called}: {sentence}", self.kind.name, job.id, title)


def named(by: str) -> str:
    """A person's name as stored: NOBODY where it is empty."""
    return by.strip() or NOBODY
