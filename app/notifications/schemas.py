"""JSON forms of events and webhooks."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.events.tables import EventKind
from app.text import PersonName, Storable

DEFAULT_KINDS = [EventKind.COMPLETED, EventKind.TRIPPED, EventKind.FAILED]


class EventOut(BaseModel):
    """One event."""

    model_config = ConfigDict(from_attributes=True)

    number: int = Field(description="number of the event; later events have larger numbers")
    at: datetime = Field(description="time of the event, UTC")
    kind: EventKind
    about: str = Field(description="what the event is about: `run`, `sweep`, `diagnosis` or `queue`")
    about_id: str | None = Field(description="id of the run or the diagnosis")
    run_id: str | None = Field(description="id of the run, for an event about a run")
    name: str = Field(description="name of the run or the diagnosis; empty for an event of the queue")
    sentence: str = Field(description="the event in words")


class EventList(BaseModel):
    """Events, newest first."""

    events: list[EventOut]
    total: int = Field(description="number of events that match, also those beyond `limit`")
    latest: int = Field(description="number of the newest event of all; 0 before the first")


class WebhookIn(BaseModel):
    """A webhook as it is added."""

    model_config = ConfigDict(extra="forbid")

    url: Storable = Field(min_length=1, max_length=2000, description="address that begins with http:// or https://")
    kinds: list[EventKind] = Field(DEFAULT_KINDS, min_length=1, description="kinds of event that are sent")
    secret: Storable = Field("", max_length=200, description="key of the signature; empty: a secret is made")
    by: PersonName = ""


class WebhookChange(BaseModel):
    """What of a webhook changes; null leaves it as it is."""

    model_config = ConfigDict(extra="forbid")

    url: Storable | None = Field(None, min_length=1, max_length=2000)
    kinds: list[EventKind] | None = Field(None, min_length=1)
    enabled: bool | None = None


class DeliveryOut(BaseModel):
    """One delivery: waiting for its first or next attempt, delivered, or failed after its last attempt."""

    number: int
    kind: str = Field(description="kind of the event, or `test`")
    sentence: str
    state: Literal["waiting", "delivered", "failed"]
    attempts: int
    next_at: datetime
    last_at: datetime | None
    status: int | None = Field(description="HTTP status of the last attempt; null where there was no answer")
    problem: str | None = Field(description="why the last attempt was not accepted")


class WebhookOut(BaseModel):
    """A webhook without its secret, and its latest delivery."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    url: str
    kinds: list[EventKind]
    enabled: bool
    added_by: str
    added_at: datetime
    last: DeliveryOut | None = None


class WebhookAdded(WebhookOut):
    """A webhook that was just added, with its secret: it is not shown again."""

    secret: str


class WebhookList(BaseModel):
    """All webhooks."""

    webhooks: list[WebhookOut]


class DeliveryList(BaseModel):
    """The latest deliveries of a webhook, newest first."""

    deliveries: list[DeliveryOut]
