"""JSON forms of events."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict, Field

from app.events.tables import EventKind


class EventOut(BaseModel):
    """One event."""

    model_config = ConfigDict(from_attributes=True)

    number: int = Field(description="number of the event; later events have larger numbers")
    at: datetime = Field(description="time of the event, UTC")
    kind: EventKind
    about: str = Field(description="what the event is about: `run`, `diagnosis` or `queue`")
    about_id: str | None = Field(description="id of the run or the diagnosis")
    run_id: str | None = Field(description="id of the run, for an event about a run")
    name: str = Field(description="name of the run or the diagnosis; empty for an event of the queue")
    sentence: str = Field(description="the event in words")


class EventList(BaseModel):
    """Events, newest first."""

    events: list[EventOut]
    total: int = Field(description="number of events that match, also those beyond `limit`")
    latest: int = Field(description="number of the newest event of all; 0 before the first")
