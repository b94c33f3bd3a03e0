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


def checked(column: Column, unit: str | None, dt: float | None, peak_agrees: bool = False) -> tuple[Array, float]:
    """Acceleration (m/s^2) and step (s). Raises MotionError with every issue.

    A given `unit` or `dt` is used where the file states none, and must not contradict the file. `peak_agrees`: the header
    states the peak that was read.
    """
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
    _check_peak(acceleration, chosen_unit, stated=bool(column.unit and column.quantity), peak_agrees=peak_agrees)
    return acceleration, step


def _unit(column: Column, unit: str | None, issues: list[Issue]) -> str | None:
    known = ", ".join(ACCELERATION_UNITS)
    try:
        given = checked_unit(unit) if unit else None
    except FileError as error:
        issues += error.issues
        return None
    if not column.unit:
        if given is None:
            issues.append(Issue("unit", "the file does not state its unit of acceleration", fix=f"choose one of {known}"))
        return given
    try:
        stated = checked_unit(column.unit)
    except FileError:
        problem = "the file states a unit that is not a unit of acceleration"
        issues.append(Issue("unit", problem, column.unit, f"give the record in one of {known}"))
        return None
    if given and units.factor(given) != units.factor(stated):
        issues.append(Issue("unit", f"the file states {stated}", given, "leave the unit empty, or correct the file"))
    return stated


def _step(column: Column, dt: float | None, issues: list[Issue]) -> float | None:
    step = column.dt if column.dt is not None else dt
    if step is None:
        issues.append(Issue("dt", "the file does not state its step", fix="give the step in seconds, for example 0.01"))
    elif not SHORTEST_STEP <= step <= LONGEST_STEP:
        issues.append(Issue("dt", f"needs a step of {SHORTEST_STEP} to {LONGEST_STEP} s", step, "give the step in seconds"))
    elif dt is not None and abs(dt / step - 1) > _SAME_STEP:
        issues.append(Issue("dt", f"the file says {step:g} s", dt, "leave the step empty, or correct the file"))
    return step


def _check_peak(acceleration: Array, unit: str, stated: bool, peak_agrees: bool) -> None:
    """Raises MotionError for a record of zeros, and for a peak that points to a wrong unit.

    A peak that the header states too is right at any size. Where the format states quantity and unit, a small peak is an
    aftershock or a far station.
    """
    pga = float(np.max(np.abs(acceleration))) / STANDARD_GRAVITY
    if pga > 0 and (peak_agrees or (0 if stated else LEAST_PGA) <= pga <= LARGEST_PGA):
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
