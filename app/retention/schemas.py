"""JSON forms of retention."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from app.jobs.states import State
from app.text import Storable, integer
from app.whole import Whole

GIGABYTE = 1e9  # bytes
MOST_DAYS, MOST_GIGABYTES = 36_500, 1e6
ENDED = (State.COMPLETED, State.TRIPPED, State.CANCELLED, State.FAILED)
Ended = Literal[State.COMPLETED, State.TRIPPED, State.CANCELLED, State.FAILED]


class Rule(BaseModel):
    """Which recordings of runs are removed; docs/operation.md. Without `days` and `gigabytes` all recordings are kept."""

    model_config = ConfigDict(extra="forbid")

    days: Annotated[int, Field(strict=True, ge=1, le=MOST_DAYS), BeforeValidator(integer)] | None = Field(
        None,
        description="recordings are kept this number of days after their tests",
    )
    gigabytes: float | None = Field(
        None, strict=True, gt=0, le=MOST_GIGABYTES, description="the oldest go until all recordings of runs take this size"
    )
    states: list[Ended] = Field([], max_length=len(ENDED), description="only of tests in these states; empty: of all")
    template: Storable = Field("", max_length=80, description="only of tests of this template; empty: of all")
    tag: Storable = Field("", max_length=40, description="only of runs with this tag; empty: of all")

    @property
    def acts(self) -> bool:
        return self.days is not None or self.gigabytes is not None

    @property
    def words(self) -> str:
        """The rule in words."""
        if not self.acts:
            return "All recordings are kept."
        days = f"{self.days} day{'s' * (self.days > 1)} after the end of its test" if self.days else ""
        full = f"while all recordings take more than {self.gigabytes:g} GB, the oldest first" if self.gigabytes else ""
        limits = [
            f"of tests that are {' or '.join(self.states)}" if self.states else "",
            f"of the template {self.template}" if self.template else "",
            f"with the tag {self.tag}" if self.tag else "",
        ]
        which = " ".join(one for one in limits if one)
        when = "; also ".join(one for one in (days, full) if one)
        return f"A recording {f'{which} ' if which else ''}is removed {when}."


class RuleIn(Rule, Whole):
    """The rule to set: every field is given, so that no limit is lifted by leaving it out."""


class RetentionOut(Rule):
    """The rule that holds, and when it removes recordings next."""

    due_at: datetime | None = Field(description="recordings are removed at this time at the earliest; null: all are kept")
    sentence: str = Field(description="the rule in words")


class Going(BaseModel):
    """A run whose recording the rule removes."""

    id: str
    number: int
    name: str
    finished_at: datetime
    size: int = Field(description="size of the recording (bytes)")


class Preview(BaseModel):
    """What a rule would remove now."""

    recordings: int = Field(description="number of recordings that the rule removes")
    bytes: int = Field(description="their size")
    total_bytes: int = Field(description="size of all recordings of runs now")
    oldest: list[Going] = Field(description="at most five of the recordings, the oldest first")
    sentence: str
