"""The table of events."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base


class EventKind(StrEnum):
    """What happened: a job started, ended or went back to the queue, or a person held or released the queue."""

    STARTED = "started"
    COMPLETED = "completed"
    TRIPPED = "tripped"
    CANCELLED = "cancelled"
    FAILED = "failed"
    REQUEUED = "requeued"
    HELD = "held"
    RELEASED = "released"


class Event(Base):
    """One event. `about` names what it is about (run, diagnosis, queue), `about_id` is the id of the run or diagnosis."""

    __tablename__ = "event"

    number: Mapped[int] = mapped_column(primary_key=True)
    at: Mapped[datetime] = mapped_column(index=True)
    kind: Mapped[str] = mapped_column(sa.String(16))
    about: Mapped[str] = mapped_column(sa.String(16))
    about_id: Mapped[str | None] = mapped_column(sa.String(36), index=True)
    name: Mapped[str] = mapped_column(sa.String(200), default="")
    sentence: Mapped[str] = mapped_column(sa.Text)

    @property
    def run_id(self) -> str | None:
        """The run of an event about a run."""
        return self.about_id if self.about == "run" else None
