"""The unit of a column without unit: from other statements in the file, from its related column, last from its magnitude."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import relations
from rths_engine.recordings.measured.names import written_unit
from rths_engine.recordings.measured.roles import dimension, to_si

# chosen; see docs/decisions/0023
_CLOSE = 0.1  # of the factor between displacement and velocity
_RELATED = 0.7  # smallest correlation at which this factor is used

# chosen; see docs/decisions/0023
# dimension -> (largest value for the unit, unit); the last unit has no bound
_MAGNITUDES: dict[str, tuple[tuple[float, str], ...]] = {
    "time": ((np.inf, "s"),),
    "length": ((0.5, "m"), (np.inf, "mm")),
    "velocity": ((3.0, "m/s"), (np.inf, "mm/s")),
    "acceleration": ((3.0, "g"), (30.0, "m/s^2"), (np.inf, "cm/s^2")),
    "force": ((3e3, "kN"), (np.inf, "N")),
    "current": ((20.0, "A"), (np.inf, "mA")),
    "temperature": ((200.0, "degC"), (np.inf, "K")),
    "voltage": ((np.inf, "V"),),
}


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit guessed for a column, and why."""

    name: str
    why: str
    by_magnitude: bool = False


def by_hint(kind: str, hints: Mapping[str, str]) -> Unit | None:
    """The unit that the file states for a quantity of this dimension."""
    for what, text in hints.items():
        unit = written_unit(text)
        if unit and dimension(unit) == kind:
            return Unit(unit, f"the file gives {unit} for {what}")
    return None


def by_partner(x: Array, x_unit: str, v: Array, dt: float) -> Unit | None:
    """The unit in which v is the derivative of x, which is in `x_unit`; dt in s."""
    found = relations.of_derivative(x, v, dt)
    if abs(found.correlation) < _RELATED:
        return None
    for unit in ("mm/s", "m/s", "in/s", "cm/s", "ft/s"):
        if abs(abs(found.factor) * to_si(unit)[0] / to_si(x_unit)[0] - 1) < _CLOSE:
            return Unit(unit, f"in {unit} it is the derivative of the displacement")
    return None


def by_magnitude(kind: str, values: Array) -> Unit:
    """The unit that the largest value suggests, where nothing else gives one."""
    peak = float(np.nanmax(np.abs(values[np.isfinite(values)]), initial=0.0))
    unit = next(name for most, name in _MAGNITUDES.get(kind, ((np.inf, "1"),)) if peak <= most)
    if kind == "time":
        return Unit(unit, "assumed to be seconds", True)
    return Unit(unit, f"its unit is unknown: {unit} only from its magnitude (largest {peak:.3g}), check it", True)
