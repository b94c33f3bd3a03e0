"""REST endpoints of events."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.access import Role, allowed
from app.dependencies import OneSession
from app.events.tables import EventKind
from app.notifications.schemas import EventList
from app.notifications.service import NotificationService
from app.times import InUtc

router = APIRouter(prefix="/api/v1", tags=["notifications"])


class Since(BaseModel):
    """Which events are asked for. An empty parameter is ignored; a time without a time zone is UTC."""

    model_config = ConfigDict(extra="forbid")

    since: InUtc | None = Field(None, description="events later than this time")
    after: int = Field(0, ge=0, le=2**62, description="events with a larger number")
    kind: list[EventKind] = []
    run_id: str = Field("", max_length=36)
    limit: int = Field(50, ge=1, le=500)

    @model_validator(mode="before")
    @classmethod
    def _given(cls, query: dict[str, Any]) -> dict[str, Any]:
        return {name: value for name, value in query.items() if value not in ("", [""])}


@router.get("/events")
@allowed(Role.VIEWER)
def events(wanted: Annotated[Since, Query()], session: OneSession) -> EventList:
    """List events, newest first: starts and ends of runs and diagnoses, and holds and releases of the queue."""
    return NotificationService(session).events(wanted.since, wanted.after, wanted.kind, wanted.run_id, wanted.limit)
