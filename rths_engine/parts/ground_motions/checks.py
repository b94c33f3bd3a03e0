"""Checks that every record from a file must pass before it becomes a motion."""

from __future__ import annotations

import numpy as np

from rths_engine.formats.table import Column
from rths_engine.formats.units_in_text import ACCELERATION_UNITS, checked_unit
from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue, MotionError
from rths_engine.foundation.units import STANDARD_GRAVITY

# chosen; see docs/decisions/0023
SHORTEST_STEP, LONGEST_STEP = 0.0005, 0.1  # s
FEWEST_SAMPLES, MOST_SAMPLES = 50, 1_000_000
LEAST_PGA, LARGEST_PGA = 0.001, 5.0  # g
_SAME_STEP = 1e-3


def checked(column: Column, unit: str | None, dt: float | None) -> tuple[Array, float]:
    """Acceleration (m/s^2) and step (s); a given `unit` overrides that of the file. Raises MotionError with every issue."""
    issues: list[Issue] = []
    chosen_unit, step = _unit(column, unit, issues), _step(column, dt, issues)
    count = len(column.values)
    if count < FEWEST_SAMPLES:
        issues.append(Issue("file", f"needs at least {FEWEST_SAMPLES} samples", count, "give the whole record"))
    if count > MOST_SAMPLES:
        issues.append(Issue("file", f"has more than {MOST_SAMPLES:,} samples", count, "cut or resample the record"))
    bad = np.flatnonzero(~np.isfinite(column.values))
    if len(bad):
        problem = "needs a finite number, not NaN or infinity"
        issues.append(Issue(f"sample {bad[0] + 1}", problem, str(column.values[bad[0]]), "mend the record"))
    if issues or chosen_unit is None or step is None:
        raise MotionError(issues)
    acceleration: Array = column.values * units.factor(chosen_unit)
    _check_peak(acceleration, chosen_unit)
    return acceleration, step


def _unit(column: Column, unit: str | None, issues: list[Issue]) -> str | None:
    if unit:
        try:
            return checked_unit(unit)
        except FileError as error:
            issues += error.issues
    elif not column.unit:
        fix = "choose one of " + ", ".join(ACCELERATION_UNITS)
        issues.append(Issue("unit", "the file does not state its unit of acceleration", fix=fix))
    return column.unit


def _step(column: Column, dt: float | None, issues: list[Issue]) -> float | None:
    step = column.dt if column.dt is not None else dt
    if step is None:
        issues.append(Issue("dt", "the file does not state its step", fix="give the step in seconds, for example 0.01"))
    elif not SHORTEST_STEP <= step <= LONGEST_STEP:
        issues.append(Issue("dt", f"needs a step of {SHORTEST_STEP} to {LONGEST_STEP} s", step, "give the step in seconds"))
    elif dt is not None and abs(dt / step - 1) > _SAME_STEP:
        issues.append(Issue("dt", f"the file says {step:g} s", dt, "leave the step empty, or correct the file"))
    return step


def _check_peak(acceleration: Array, unit: str) -> None:
    pga = float(np.max(np.abs(acceleration))) / STANDARD_GRAVITY
    if LEAST_PGA <= pga <= LARGEST_PGA:
        return
    problem = f"given as {unit} the record peaks at {pga:.3g} g, outside {LEAST_PGA} to {LARGEST_PGA:g} g"
    if pga == 0:
        raise MotionError(Issue("file", "the record is zero throughout", fix="choose another record or channel"))
    other = _better_unit(pga, unit)
    fix = f"looks like {other} given as {unit}: choose the unit" if other else "check the record and its unit"
    raise MotionError(Issue("unit", problem, unit, fix))


def _better_unit(pga: float, unit: str) -> str | None:
    """The most common unit in which the record would peak between 0.02 g and 3 g."""
    for other in ("g", "cm/s^2", "m/s^2", "mm/s^2"):
        if other != unit and 0.02 <= pga * units.factor(other) / units.factor(unit) <= 3:
            return other
    return None
