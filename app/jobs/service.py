"""Rules of jobs of every kind: submit, start, cancel, end and take over. No SQL, no HTTP."""

from __future__ import annotations

import logging
import uuid
from collections.abc import Container, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any, Generic, Protocol

from sqlalchemy.orm import Session

from app import metrics
from app.db import afterwards
from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs import states
from app.jobs.hold import Hold
from app.jobs.kind import Kind, Result, Row
from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.problems import Conflict, NotFound
from rths_engine import __version__

log = logging.getLogger("rths.jobs")
MOST_ATTEMPTS = 3
UNDO = timedelta(minutes=10)  # how long the cancel of a queued job can be undone
NOBODY = "unnamed"


class Queue(Protocol):
    """The part of the durable queue that submitting uses."""

    def enqueue(self, session: Session, kind: Kind[Any, Any, Any], ids: Sequence[str]) -> None: ...


@dataclass(frozen=True, slots=True)
class Taken(Generic[Row]):
    """What a delivery of the durable queue comes to: a job that started, or a wait, or nothing left to do.

    `left` is the job of the delivery that an earlier attempt left, or that has ended: its files of earlier attempts go.
    """

    started: Row | None = None
    left: Row | None = None
    waits: bool = False


class JobService(Generic[Row, Result]):
    """Rules of the jobs of one kind. Every change of a job's state goes through this class and TRANSITIONS."""

    def __init__(self, session: Session, kind: Kind[Row, Any, Result], queue: Queue | None = None):
        table: Any = kind.table
        self.rows: JobRepository[Row] = JobRepository(session, table)
        self.session, self.kind, self.queue = session, kind, queue

    def submit(self, jobs: Sequence[Row], by: str, first: State = State.QUEUED) -> None:
        """Store and queue jobs, all in the transaction of the session; those that are TO_APPROVE first are only stored."""
        for job in jobs:
            job.id, job.state, job.attempt = str(uuid.uuid4()), first, 0
            job.submitted_by, job.submitted_at = named(by), datetime.now(UTC)
        self.rows.add(jobs)
        if first is State.TO_APPROVE:
            for job in jobs:
                self._tell(EventKind.TO_APPROVE, job, f"{job.submitted_by} submitted it. Another person approves it.")
            return
        assert self.queue is not None
        self.queue.enqueue(self.session, self.kind, [job.id for job in jobs])

    def approve(self, job_id: str, by: str) -> Row:
        """Queue a job that was to be approved. Raises IllegalTransition for any other job."""
        job = self.locked(job_id)
        if job.state is not State.TO_APPROVE:
            raise states.IllegalTransition(self.kind.noun, job.state, State.QUEUED)
        self._move(job, State.QUEUED)
        self._tell(EventKind.APPROVED, job, f"{named(by)} approved it.")
        self._enqueue_again(job)
        return job

    def reject(self, job_id: str, by: str, reason: str) -> Row:
        """End a job that was to be approved. Raises IllegalTransition for any other job."""
        job = self.locked(job_id)
        if job.state is not State.TO_APPROVE:
            raise states.IllegalTransition(self.kind.noun, job.state, State.CANCELLED)
        self._end(job, State.CANCELLED, f"Rejected by {named(by)}: {reason}")
        return job

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
        if job.state.ended:
            raise states.IllegalTransition(self.kind.noun, job.state, State.CANCELLED)
        if job.state is not State.RUNNING:
            self._end(job, State.CANCELLED, f"Cancelled by {named(by)} before it started.")
        else:
            job.cancel_requested_by = named(by)
        return job

    def undo_cancel(self, job_id: str, by: str, to: State = State.QUEUED) -> Row:
        """Put a job back at its place in the queue that was cancelled there, or let it wait for approval (TO_APPROVE).

        Raises Conflict for any other job.
        """
        job = self.locked(job_id)
        noun = self.kind.noun
        if job.state is not State.CANCELLED:
            raise Conflict(f"The {noun} is {job.state}, not cancelled. There is no cancel to undo.")
        if job.started_at is not None:
            raise Conflict(f"The {noun} was running when it was cancelled. Retry it instead.")
        if not undoable(job):
            minutes = UNDO // timedelta(minutes=1)
            raise Conflict(f"The cancel of the {noun} is more than {minutes} minutes old. Retry the {noun} instead.")
        self._move(job, to)
        job.reason, job.finished_at = None, None
        if to is State.TO_APPROVE:
            self._tell(EventKind.TO_APPROVE, job, f"{named(by)} undid the cancel. Another person approves it.")
            return job
        self._tell(EventKind.REQUEUED, job, f"Back in the queue: {named(by)} undid the cancel.")
        self._enqueue_again(job)
        return job

    def _enqueue_again(self, job: Row) -> None:
        """A turn for a job that may have had one, which may have passed. Ordered kinds start their first job by any turn."""
        assert self.queue is not None
        self.queue.enqueue(self.session, self.kind, [str(uuid.uuid4()) if self.kind.ordered else job.id])

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

    def start(self, turn: str, worker: str, held: bool = False, heard: Container[tuple[str, int]] | None = None) -> Taken[Row]:
        """Start the job of a delivery of the durable queue, in one transaction. `turn` is the id that was delivered.

        `held`: the worker holds all starts, because of an Abort that the database does not know yet. `heard`: the attempts that
        this worker knows to have started. Another one of its own is a start that was stored, but whose answer got lost: it is
        the start of this delivery, and not the trace of a death.

        For an ordered kind this is the first queued job that may start now, otherwise the job with that id. A running job that
        this turn started before was left by a worker that died; it goes back to its place in the queue first.
        """
        queue = Hold(self.session).locked() if self.kind.waits_while_held else None
        job_id = self._job_of(turn)
        left = self.rows.locked(job_id) if job_id else None
        if left is not None and heard is not None and self._unheard(left, worker, heard):
            return Taken(started=left, left=left)
        if left is not None and (left.state.ended or not self._bears_attempt(left)):
            return Taken(left=left)
        if queue is not None and (queue.held or held):
            return Taken(left=left, waits=self.rows.any_in(State.QUEUED))
        job = self.rows.first(self.kind.may_start(), turn) if self.kind.ordered else left
        if job is None:
            return Taken(left=left, waits=self.kind.ordered and self.rows.any_in(State.QUEUED))
        self._move(job, State.RUNNING)
        job.attempt += 1
        job.worker, job.started_at, job.doing, job.share = worker, datetime.now(UTC), "", 0.0
        job.started_version = __version__
        again = f", attempt {job.attempt}" if job.attempt > 1 else ""
        waited, kind = (job.started_at - job.submitted_at).total_seconds(), self.kind.name
        afterwards(self.session, "after_commit", lambda: metrics.WAIT_SECONDS.labels(kind).observe(waited))
        queued = self.kind.queued_version(job) or __version__
        other = (
            "" if queued == __version__ else f" Version {queued} of the program queued it, version {__version__} executes it."
        )
        self._tell(EventKind.STARTED, job, f"Started on worker {worker}{again}.{other}")
        return Taken(started=job, left=left)

    def over(self, turn: str) -> bool:
        """Whether the job of a delivery has ended, read without a lock."""
        job_id = self._job_of(turn)
        job = self.rows.get(job_id) if job_id else None
        return job is not None and job.state.ended

    def may_start(self) -> bool:
        """Whether a turn that waits should try to start again, read without a lock."""
        if self.kind.waits_while_held and Hold(self.session).held:
            return False
        if not self.kind.ordered or not self.rows.any_in(State.QUEUED):
            return True
        return self.rows.any_in(State.QUEUED, self.kind.may_start())

    def _unheard(self, job: Row, worker: str, heard: Container[tuple[str, int]]) -> bool:
        """Whether this worker started an attempt without knowing it."""
        return job.state is State.RUNNING and job.worker == worker and (job.id, job.attempt) not in heard

    def _job_of(self, turn: str) -> str | None:
        return self.rows.of_turn(turn) if self.kind.ordered else turn

    def _bears_attempt(self, job: Row) -> bool:
        """Move a running job of a dead worker to the queue, or end it.

        It ends where it is cancelled, not to be repeated, torn off by a change of the program, or without attempts.
        """
        begun = job.state is State.RUNNING
        if begun:
            self._move(job, State.QUEUED)
            if self.kind.ordered:
                self.rows.give_back(job)
        noun = self.kind.noun
        if job.cancel_requested_by:
            died = f"The worker or the process of the {noun} had died."
            self._end(job, State.CANCELLED, f"Cancelled by {job.cancel_requested_by}. {died}")
        elif begun and (reason := self.kind.not_repeated(job)):
            self._end(job, State.FAILED, f"The worker or the process of the {noun} died. {reason}")
        elif begun and job.started_version != __version__:
            old = f"version {job.started_version}" if job.started_version else "an earlier version"
            torn = f"The {noun} was running in {old} of the program when its worker ended; this is version {__version__}"
            self._end(job, State.FAILED, f"{torn}, so it is not started again by itself. {self.kind.again}")
        elif job.attempt >= MOST_ATTEMPTS:
            died = f"The worker or the process of the {noun} died {job.attempt} times"
            self._end(job, State.FAILED, f"{died}. There is no further attempt.")
        return not job.state.ended

    def progress(self, job_id: str, attempt: int, doing: str, share: float) -> None:
        """Store the progress of an attempt; nothing happens if the attempt is not the current one."""
        self.rows.progress(job_id, attempt, doing, share)

    def to_stop(self, job_id: str, attempt: int) -> bool:
        """Whether an attempt that runs should stop: someone cancelled it, or another worker took the job over meanwhile."""
        return self.rows.to_stop(job_id, attempt)

    def asked_to_stop(self, job_id: str, attempt: int, by: str) -> None:
        """Note who stopped an attempt, where the database does not know it yet."""
        job = self._current(job_id, attempt)
        if job is not None and not job.cancel_requested_by:
            job.cancel_requested_by = named(by)

    def keep(self, job_id: str, attempt: int, parts: Sequence[Any]) -> None:
        """Store parts of the result of an attempt; nothing happens if the job has ended or was taken over."""
        job = self._current(job_id, attempt)
        if job is None:
            return
        for part in parts:
            self.kind.store_part(job, part)

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

    def finish_late(self, job: Row, result: Result) -> None:
        """Store the result of a job that failed only because its result was not stored. The caller has locked the job."""
        state, reason = self.kind.store(job, result)
        self._move(job, state)
        job.reason = f"{reason} Its worker kept the result, which was not stored at first, and sent it later."
        if state is State.COMPLETED:
            job.share = 1.0
        self._tell(EventKind(state), job, job.reason)

    def fail(self, job_id: str, attempt: int, reason: str, stopped: bool = False) -> None:
        """End a job whose attempt failed, unless it has ended or was taken over.

        `stopped`: it had stopped because it was cancelled, and failed when its result was saved, as on a full disk.
        """
        job = self._current(job_id, attempt)
        if job is not None and stopped and job.cancel_requested_by:
            self._end(job, State.CANCELLED, f"Cancelled by {job.cancel_requested_by}. No result was stored: {reason}")
        elif job is not None:
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
        if job.started_at is not None:
            lasted = (job.finished_at - job.started_at).total_seconds()
            kind = metrics.RUN_SECONDS.labels(self.kind.name, str(state))
            afterwards(self.session, "after_commit", lambda: kind.observe(lasted))
        self._tell(EventKind(state), job, reason)

    def _tell(self, kind: EventKind, job: Row, sentence: str) -> None:
        if not self.kind.told:
            return
        title = self.kind.title(job)
        self._log(sentence, job)
        called = f"{self.kind.name.capitalize()} {job.number}{', ' if title else ''}{title}"
        EventLog(self.session).add(kind, f"{called}: {sentence}", self.kind.name, job.id, title)

    def _log(self, sentence: str, job: Row) -> None:
        """Write what happened to a job into the log, when it is stored."""
        about = {"run": job.id, "kind": self.kind.name, "number": str(job.number), "state": str(job.state)}
        afterwards(self.session, "after_commit", lambda: log.info("%s", sentence, extra={"fields": about}))


def undoable(job: Any) -> bool:
    """Whether a job was cancelled before it started, so short ago that this can be undone."""
    ended = job.finished_at if job.state is State.CANCELLED and job.started_at is None else None
    return ended is not None and datetime.now(UTC) - ended <= UNDO


def named(by: str) -> str:
    """A person's name as stored: NOBODY where it is empty."""
    return by.strip() or NOBODY
