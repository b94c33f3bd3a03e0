"""The unit of a column whose name has none: from other statements in the file, never assumed; a unit that fits is named."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rths_engine.foundation import unit_names
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import relations
from rths_engine.recordings.measured.roles import to_si

# chosen; see docs/decisions/0023
_CLOSE = 0.1  # of the factor between displacement and velocity
_RELATED = 0.7  # smallest correlation at which this factor is used

# chosen; see docs/decisions/0023
# dimension -> (largest value for the unit, unit); the last unit has no bound
_MAGNITUDES: dict[str, tuple[tuple[float, str], ...]] = {
    "length": ((0.5, "m"), (np.inf, "mm")),
    "velocity": ((3.0, "m/s"), (np.inf, "mm/s")),
    "acceleration": ((3.0, "g"), (30.0, "m/s^2"), (np.inf, "cm/s^2")),
    "force": ((3e3, "kN"), (np.inf, "N")),
    "current": ((20.0, "A"), (np.inf, "mA")),
    "temperature": ((200.0, "degC"), (np.inf, "K")),
}


def by_hint(kind: str, hints: Mapping[str, str]) -> tuple[str, str]:
    """The unit that the file states for a quantity of this dimension, and what it states; no unit where it states several."""
    found = {what: written for what, text in hints.items() if (written := unit_names.read(text)).dimension == kind}
    said = "the file gives " + ", ".join(f"{written.text} for {what}" for what, written in found.items()) if found else ""
    stated = {written.plain for written in found.values()}
    return (stated.pop() if len(stated) == 1 else ""), said


def derivative_unit(x: Array, x_unit: str, v: Array, dt: float) -> str:
    """The unit in which v is the derivative of x, which is in `x_unit`; dt in s. Empty where v is not this derivative."""
    found = relations.of_derivative(x, v, dt)
    if abs(found.correlation) < _RELATED:
        return ""
    for unit in ("mm/s", "m/s", "in/s", "cm/s", "ft/s"):
        if abs(abs(found.factor) * to_si(unit)[0] / to_si(x_unit)[0] - 1) < _CLOSE:
            return unit
    return ""


def fitting(kind: str, values: Array) -> str:
    """A sentence that names the unit that the largest value suggests; empty where no unit is more likely."""
    peak = float(np.nanmax(np.abs(values[np.isfinite(values)]), initial=0.0))
    unit = next((name for most, name in _MAGNITUDES.get(kind, ()) if peak <= most), "")
    return f"{unit} would fit its magnitude (largest {peak:.3g})" if unit else ""
