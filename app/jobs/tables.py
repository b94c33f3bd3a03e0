"""Columns of every kind of job, and the tables of the hold of the queue and of workers."""

from __future__ import annotations

from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base
from app.jobs.states import State


class Job:
    """Columns of the table of a kind of job, as a mixin: `class Run(Job, Base)`. Times are UTC.

    `attempt` counts the starts; `worker` names the worker of the last start, and `started_version` its version of the program
    (null for a start by a version before there was this column). `doing` and `share` (0 to 1) are the progress
    of the running attempt. `reason` is the reason for the end of the job.
    """

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    state: Mapped[State] = mapped_column(sa.Enum(State, native_enum=False, length=16, values_callable=State.values), index=True)
    submitted_by: Mapped[str] = mapped_column(sa.String(80))
    submitted_at: Mapped[datetime]
    started_at: Mapped[datetime | None]
    finished_at: Mapped[datetime | None]
    cancel_requested_by: Mapped[str | None] = mapped_column(sa.String(80))
    attempt: Mapped[int] = mapped_column(default=0)
    worker: Mapped[str | None] = mapped_column(sa.String(80))
    started_version: Mapped[str | None] = mapped_column(sa.String(40))
    doing: Mapped[str] = mapped_column(sa.String(200), default="")
    share: Mapped[float] = mapped_column(default=0.0)
    reason: Mapped[str | None] = mapped_column(sa.Text)


class Ordered:
    """Columns of a kind of job whose jobs people order, as a mixin: `class Run(Ordered, Job, Base)`.

    Jobs start by `priority`, the highest first, and then by `position`; the position of a job that nobody moved is its number.
    `turn` names the delivery of the durable queue that executes the job, and `beside` is the number of others that ran when it
    started.
    """

    priority: Mapped[int] = mapped_column(default=0, server_default="0")
    position: Mapped[float | None]
    turn: Mapped[str | None] = mapped_column(sa.String(36), index=True)
    beside: Mapped[int | None]


class QueueState(Base):
    """Whether the queue is held, by whom, since when and why: one row."""

    __tablename__ = "queue_state"

    id: Mapped[int] = mapped_column(primary_key=True)
    held: Mapped[bool] = mapped_column(default=False)
    held_by: Mapped[str | None] = mapped_column(sa.String(80))
    held_at: Mapped[datetime | None]
    held_reason: Mapped[str] = mapped_column(sa.String(200), default="", server_default="")

    @property
    def sentence(self) -> str:
        """Who holds the queue, and why."""
        return f"queue held by {self.held_by}{': ' if self.held_reason else ''}{self.held_reason}"


class AbortPress(Base):
    """One press of Abort: who and when, when it was recorded, and who released the queue after it."""

    __tablename__ = "abort_press"

    id: Mapped[str] = mapped_column(sa.String(36), primary_key=True)
    pressed_by: Mapped[str] = mapped_column(sa.String(80))
    pressed_at: Mapped[datetime]
    recorded_at: Mapped[datetime]
    released_at: Mapped[datetime | None]
    released_by: Mapped[str | None] = mapped_column(sa.String(80))


class WorkerHeartbeat(Base):
    """Time of the last heartbeat of a worker, and how many tests it executes at the same time."""

    __tablename__ = "worker_heartbeat"

    worker: Mapped[str] = mapped_column(sa.String(80), primary_key=True)
    seen_at: Mapped[datetime]
    tests_at_a_time: Mapped[int] = mapped_column(default=1, server_default="1")
