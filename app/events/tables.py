"""The tables of events, of webhooks, and of what is delivered to them."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column, relationship

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
    TO_APPROVE = "to approve"
    APPROVED = "approved"


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


class Webhook(Base):
    """A webhook: an address that receives events of some kinds. `secret` signs each message."""

    __tablename__ = "webhook"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    url: Mapped[str] = mapped_column(sa.Text)
    kinds: Mapped[list[str]] = mapped_column(sa.JSON)
    secret: Mapped[str] = mapped_column(sa.String(200))
    enabled: Mapped[bool] = mapped_column(default=True)
    added_by: Mapped[str] = mapped_column(sa.String(80))
    added_at: Mapped[datetime]


class WebhookDelivery(Base):
    """One event for one webhook; no event is a test. It waits until `next_at`, and is stored with the event that it tells."""

    __tablename__ = "webhook_delivery"

    number: Mapped[int] = mapped_column(primary_key=True)
    webhook_number: Mapped[int] = mapped_column(sa.ForeignKey("webhook.number", ondelete="CASCADE"), index=True)
    event_number: Mapped[int | None] = mapped_column(sa.ForeignKey("event.number"))
    state: Mapped[str] = mapped_column(sa.String(16), default="waiting", index=True)
    attempts: Mapped[int] = mapped_column(default=0)
    next_at: Mapped[datetime]
    last_at: Mapped[datetime | None]
    status: Mapped[int | None]
    problem: Mapped[str | None] = mapped_column(sa.Text)
    webhook: Mapped[Webhook] = relationship(lazy="joined")
    event: Mapped[Event | None] = relationship(lazy="joined")
