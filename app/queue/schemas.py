"""JSON forms of the queue."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, Field

from app.runs.schemas import Person, RunOut
from app.text import Storable, integer

MOST_RUNS = 1000  # runs in one request, and in one answer
Ids = Annotated[list[Annotated[Storable, Field(max_length=36)]], Field(min_length=1, max_length=MOST_RUNS)]
Priority = Annotated[int, Field(strict=True, ge=-1, le=2), BeforeValidator(integer)]
PRIORITIES = {2: "urgent", 1: "high", 0: "normal", -1: "low"}


class RunningOut(RunOut):
    """A running test, and when it is expected to end."""

    expected_end: datetime | None = Field(None, description="null where it is not known")


class WaitingOut(BaseModel):
    """A queued test: its place, why it waits, and when it is expected to start and to end."""

    id: str
    number: int
    name: str
    position: int = Field(description="place in the queue, 1 is the next")
    priority: int = Field(description="2 urgent, 1 high, 0 normal, -1 low; higher priorities start first")
    rig_id: str
    rig_name: str
    submitted_by: str
    submitted_at: datetime
    pace: float | None = Field(description="planned speed factor; null: as fast as possible")
    duration_s: float
    retry_of: str | None
    waits: str = Field(description="why the test waits, in words")
    expected_s: float | None = Field(description="expected time of the test, s; null where it is not known")
    expected_from: str = Field(description="what the expected time follows from, in words")
    expected_start: datetime | None = Field(description="null where it is not known, or the queue is held")
    expected_end: datetime | None


class UndoOut(BaseModel):
    """A test that was cancelled while it waited, and until when the cancel can be undone."""

    id: str
    number: int
    name: str
    rig_id: str
    reason: str
    until: datetime


class QueueOut(BaseModel):
    """The queue: held or not, what runs, what waits in which order, and the workers."""

    held: bool
    held_by: str | None
    held_at: datetime | None
    held_reason: str
    queued: int = Field(description="number of queued tests, also those beyond `limit`")
    running: list[RunningOut]
    waiting: list[WaitingOut] = Field(description="queued tests in the order in which they start")
    undoable: list[UndoOut] = Field(description="latest cancels of waiting tests that can be undone")
    total_s: float | None = Field(description="expected time until the last test of the queue has ended, s")
    tests_at_a_time: int = Field(description="number of tests that the living workers execute at the same time")
    worker_seen_at: datetime | None
    worker_alive: bool


class Move(Person):
    """Queued runs, their new place (before or after another queued run, or at an end of the queue), and who moves them."""

    runs: Ids
    before: Storable | None = Field(None, max_length=36, description="id of a queued run")
    after: Storable | None = Field(None, max_length=36, description="id of a queued run")
    to: Literal["top", "bottom"] | None = None


class NewPriority(Person):
    """Queued runs, their new priority, and the person who gives it."""

    runs: Ids
    priority: Priority = Field(description="2 urgent, 1 high, 0 normal, -1 low")


class Cancelled(Person):
    """Runs to cancel, and the person who cancels them."""

    runs: Ids


class HoldIn(Person):
    """The person who holds the queue, and why."""

    reason: Storable = Field("", max_length=200)


class Refusal(BaseModel):
    """A run of a request that was left as it is, and why."""

    id: str
    reason: str


class CancelledOut(BaseModel):
    """The runs that were cancelled or are stopping, and those that were left as they are."""

    cancelled: list[str]
    refused: list[Refusal]
