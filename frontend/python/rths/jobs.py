"""The jobs of the control room as values: runs, sweeps and diagnoses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self

ENDED = frozenset({"completed", "tripped", "cancelled", "failed"})
Json = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Job:
    """A job as the service last described it. `data` is the whole answer of the service."""

    route: ClassVar[str]
    id: str
    name: str
    state: str
    share: float
    reason: str | None
    data: Json

    @classmethod
    def of(cls, data: Json) -> Self:
        """A job from the answer of the service."""
        return cls(data["id"], data["name"], data["state"], float(data["share"]), data["reason"], data)

    @property
    def ended(self) -> bool:
        return self.state in ENDED

    @property
    def doing(self) -> str:
        """What the job does now, in words."""
        return str(self.data.get("doing") or self.state)


@dataclass(frozen=True, slots=True)
class Run(Job):
    """A test in the queue, running or ended."""

    route: ClassVar[str] = "runs"

    @property
    def number(self) -> int:
        return int(self.data["number"])

    @property
    def stations(self) -> list[dict[str, Any]]:
        """Name and measures of each station, in the units shown: the key of a measure ends with its unit."""
        return list(self.data["stations"])

    @property
    def trip(self) -> dict[str, Any] | None:
        """Station, limit, value and time (s) of the trip; None if no limit was exceeded."""
        return self.data["trip"]  # type: ignore[no-any-return]


@dataclass(frozen=True, slots=True)
class Sweep(Job):
    """Many variations of a plan."""

    route: ClassVar[str] = "sweeps"

    @property
    def points(self) -> int:
        return int(self.data["points"])

    @property
    def done(self) -> int:
        """Points that have a result."""
        return int(self.data["done"])

    @property
    def doing(self) -> str:
        return f"{self.done} of {self.points} points"


@dataclass(frozen=True, slots=True)
class Diagnosis(Job):
    """A comparison of a recording with the models of a plan."""

    route: ClassVar[str] = "diagnoses"

    @property
    def sentence(self) -> str | None:
        """The first sentence of the verdict; None before the diagnosis has completed."""
        return self.data["sentence"]  # type: ignore[no-any-return]
