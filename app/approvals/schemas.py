"""JSON forms of approvals."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import BaseModel, Field

from app.control.schemas import Driver
from app.text import Named, Storable


class ApprovalOut(BaseModel):
    """A run or a sweep that waits for approval."""

    about: Literal["run", "sweep"]
    id: str = Field(description="id of the run or the sweep")
    number: int
    name: str
    rig_name: str | None = Field(description="rig of a run; null for a sweep, which moves none")
    duration_s: float | None = Field(description="planned duration of a run; null for a sweep")
    pace: float | None = Field(description="planned speed factor of a run; null: as fast as possible, or a sweep")
    points: int | None = Field(description="points of a sweep; null for a run")
    digest: str = Field(description="digest of the whole plan, pace and name included, or of the sweep: approve exactly this")
    asked_by: str
    asked_at: datetime
    own: bool = Field(description="whether the person of the request submitted it, and may withdraw it by `cancel`")
    refusal: str | None = Field(description="why the person of the request can't decide; null where that person can")


class ApprovalList(BaseModel):
    """What waits for approval, oldest first."""

    approvals: list[ApprovalOut]


class Approve(Driver):
    """The person who approves, and the digest of what the person has seen."""

    digest: Storable = Field(max_length=64)


class Reject(Driver):
    """The person who rejects, and why."""

    reason: Named = Field(max_length=200)


class Decided(BaseModel):
    """A decision."""

    about: Literal["run", "sweep"]
    id: str
    decision: Literal["approved", "rejected"]
    decided_by: str
    decided_at: datetime
