"""Safety limits of a station and the trip that ends a run."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from rths_engine.foundation import units
from rths_engine.foundation.part import Value, quantity

# chosen; see docs/decisions/0023
LONG = 1e9  # shown with an exponent from here on
# limit -> (words, SI unit, unit shown); the position is the code in the compiled loop
LIMITS = {
    "displacement": ("command displacement", "m", "mm"),
    "velocity": ("command velocity", "m/s", "mm/s"),
    "force": ("measured force", "N", "kN"),
    "oscillation": ("number of consecutive half waves of the command", "1", "1"),
}


class Limits(Value):
    """Checked every substep, before the command is sent (displacement, velocity, oscillation) and after the force is measured.

    A value that is not a number also trips. Source: Chen and Ricles (2012), section 5: 200 mm and 300 mm/s. `oscillation`
    replaces an operator who stops a growing or lasting oscillation below these limits.
    """

    displacement: float = quantity("Command displacement limit", "m", "mm", gt=0, le=10, default=0.2)
    velocity: float = quantity("Command velocity limit", "m/s", "mm/s", gt=0, le=10, default=0.3)
    force: float = quantity("Measured force limit", "N", "kN", gt=0, le=1e9, default=1.0e6)
    oscillation: int = quantity(
        "Limit of consecutive half waves",
        ge=0,
        le=1000,
        default=0,
        help="oscillation of the command above 2.5 Hz and 20 mm/s that does not decay; 0: no limit",
    )


def _exceeding(value: float, unit: str) -> str:
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else "infinite"
    return f"{value:.1f}{unit}" if abs(value) < LONG else f"{value:.3g}{unit}"


@dataclass(frozen=True, slots=True)
class Trip:
    """The limit that ended a run: station (from 1), limit, value and bound in SI, substep (from 1) and its time (s)."""

    station: int
    name: str
    limit: str
    value: float
    bound: float
    unit: str
    time_s: float
    substep: int

    @property
    def sentence(self) -> str:
        words, _, shown = LIMITS[self.limit]
        value, bound = units.from_si(self.value, shown), units.from_si(self.bound, shown)
        unit = f" {units.pretty(shown)}".rstrip()
        return (
            f"Tripped at {self.time_s:.3f} s: {words} of station {self.station} ({self.name}) was {_exceeding(value, unit)}, "
            f"beyond its limit of {bound:g}{unit}."
        )

    def as_dict(self) -> dict[str, Any]:
        """JSON form: a value that is not finite becomes None."""
        finite = self.value if abs(self.value) < float("inf") else None
        return {**asdict(self), "value": finite, "sentence": self.sentence}


@dataclass(frozen=True, slots=True)
class Stop(Trip):
    """The trip of a run that ended early for a reason other than a limit. It belongs to no station and exceeded no bound.

    `limit` names the cause, and `reason` is a sentence.
    """

    reason: str

    @classmethod
    def at(cls, substep: int, dt: float, cause: str, reason: str) -> Stop:
        """The stop after `substep` controller steps of `dt` (s)."""
        return cls(0, "", cause, math.nan, math.nan, "1", substep * dt, substep, reason)

    @property
    def sentence(self) -> str:
        return f"Stopped at {self.time_s:.3f} s. {self.reason}"

    def as_dict(self) -> dict[str, Any]:
        """JSON form of a trip, with None for what a stop does not have."""
        own = {**asdict(self), "station": None, "value": None, "bound": None, "sentence": self.sentence}
        return {name: value for name, value in own.items() if name != "reason"}
