"""The contract between the engine and an external rig: open, command, measure, close.

The engine calls an adapter in this order, always from one thread:

    open      connect, compare units and limits with the plan, and read the rig at rest, without moving it
    command   once every controller step: send the command and return without waiting for the rig
    measure   once every controller step, after `command`: wait for the readings that belong to this command
    close     the safe end, on every way out: hold the last command, then end the connection; it raises nothing

Values are SI with the signs of the plan: a positive displacement moves the specimen in the direction of the storey drift, and
the force of the specimen resists it, so that a spring's force is positive at a positive displacement. `Scale` converts them to
the units and signs of the rig. The engine sends only finite commands within the displacement limit of the station, and checks
that the readings are finite. An adapter waits at most `patience`; then it raises `Lost`, and the test ends by `close`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal, NamedTuple

from pydantic import Field

from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.foundation.part import Value, quantity

Length = Literal["m", "mm", "cm", "um", "in"]
Force = Literal["N", "kN", "MN", "kgf", "lbf", "kip"]


class Reading(NamedTuple):
    """What a rig measures: displacement (m) and force (N); None where the models of the plan give the quantity."""

    displacement: float | None
    force: float | None


class Lost(Exception):
    """The rig is lost during a test. The message tells what happened, as the end of a sentence: "the rig closed it"."""


class RigError(RthsError):
    """An external rig that cannot be opened, or that contradicts the plan."""


@dataclass(frozen=True, slots=True)
class Terms:
    """What a test asks of a rig: its place in the plan, the controller step (s), and the limits of the station (SI).

    `folder` holds the files that the service keeps for connections; None: paths are those of the command line.
    """

    where: str
    dt: float
    displacement_limit: float
    force_limit: float
    folder: Path | None = None

    def refused(self, field: str, problem: str, value: Any = None, fix: str | None = None) -> RigError:
        """The error of a field of the connection."""
        return RigError(Issue(".".join(filter(None, (self.where, field))), problem, value, fix))


class Scale(NamedTuple):
    """SI values of one unit of the rig, negative where the rig counts in the opposite direction."""

    displacement: float
    force: float


class Adapter(ABC):
    """An external rig in one run."""

    @abstractmethod
    def open(self) -> Reading:
        """Connect, compare the rig with the plan, and read it at rest. Raises RigError; nothing has moved then."""

    @abstractmethod
    def command(self, displacement: float, current: float, time: float) -> None:
        """Send the command (m, A) that the rig shall reach at `time` (s) of the test. Raises Lost."""

    @abstractmethod
    def measure(self) -> Reading:
        """Wait for the readings of the last command. Raises Lost."""

    @abstractmethod
    def close(self) -> None:
        """The safe end: hold the last command, then end the connection. Raises nothing, also after `Lost`."""


class External(Value):
    """Fields of every connection with an external rig."""

    kind: str
    external: ClassVar[bool] = True
    physical: ClassVar[bool] = True
    """Whether the rig can be a machine: it then needs the pace of a clock, and executes one test at a time."""
    displacement_unit: Length = Field("mm", title="Unit of displacements")
    displacement_reversed: bool = Field(
        False, title="Displacements reversed", description="the rig counts them in the opposite direction"
    )
    force_unit: Force = Field("kN", title="Unit of forces")
    force_reversed: bool = Field(False, title="Forces reversed", description="the rig counts them in the opposite direction")
    patience: float = quantity(
        "Longest wait for a reading", "s", "ms", ge=0.001, le=60, default=0.5, help="then the test ends safely"
    )
    start_within: float = quantity(
        "Largest displacement at the start",
        "m",
        "mm",
        ge=0,
        le=1,
        default=0.001,
        help="a rig farther from zero would jump: refused",
    )

    @property
    def scale(self) -> Scale:
        """SI values of one unit of the rig, with signs."""
        return Scale(
            units.factor(self.displacement_unit) * (-1 if self.displacement_reversed else 1),
            units.factor(self.force_unit) * (-1 if self.force_reversed else 1),
        )

    @property
    def gives(self) -> Reading:
        """A reading with zeros for what the rig measures and None for what the models of the plan give."""
        return Reading(0.0, 0.0)

    @property
    def takes_current(self) -> bool:
        """Whether the rig gets the current of a semi-active controller."""
        return False

    @property
    def peer(self) -> str:
        """The rig in a sentence: `generic server 127.0.0.1:8090 (TCP)`."""
        raise NotImplementedError

    def adapter(self, terms: Terms) -> Adapter:
        """The adapter of one run, not open yet."""
        raise NotImplementedError
