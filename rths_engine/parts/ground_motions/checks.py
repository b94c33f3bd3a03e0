"""Checks that every record from a file must pass before it becomes a motion."""

from __future__ import annotations

import numpy as np

from rths_engine.formats.plain.record_time import LONGEST_STEP, SHORTEST_STEP
from rths_engine.formats.table import Column
from rths_engine.formats.units_in_text import ACCELERATION_UNITS, checked_unit
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue, MotionError
from rths_engine.foundation.units import STANDARD_GRAVITY

# chosen; see docs/decisions/0023
FEWEST_SAMPLES, MOST_SAMPLES = 50, 1_000_000
LEAST_PGA, LARGEST_PGA = 0.001, 5.0  # g
_SAME_STEP = 1e-3
_COUNT = "count"


def checked(column: Column, unit: str | None, dt: float | None, peak_agrees: bool = False) -> tuple[Array, float]:
    """Acceleration (m/s^2) and step (s). Raises MotionError with every issue.

    A given `unit` or `dt` is used where the file states none, and must not contradict the file. Counts need the acceleration
    of one count as `unit`, for example `2.34e-6 m/s^2`; their mean is removed. `peak_agrees`: the header states the peak that
    was read.
    """
    issues: list[Issue] = []
    counted = in_counts(column)
    chosen_unit, step = (_of_count if counted else _unit)(column, unit, issues), _step(column, dt, issues)
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
    factor, shown = chosen_unit
    acceleration: Array = (column.values - np.mean(column.values) if counted else column.values) * factor
    _check_peak(acceleration, shown, stated=bool(column.unit and column.quantity), peak_agrees=peak_agrees)
    return acceleration, step


def in_counts(column: Column) -> bool:
    """Whether the file gives the counts of a recorder and not the acceleration of one count."""
    return unit_names.read(column.unit).plain == _COUNT


def _of_count(column: Column, unit: str | None, issues: list[Issue]) -> tuple[float, str] | None:
    """The acceleration of one count, SI, and its text; it is negative where the sensor is reversed."""
    typed = (unit or "").strip()
    written = unit_names.read(typed.removeprefix("-"))
    if written.dimension == "acceleration":
        sign = -1.0 if typed.startswith("-") else 1.0
        return sign * written.scale * units.factor(written.unit), f"{typed} a count"
    problem = "the file gives counts, not acceleration" if not typed else "is not the acceleration of one count"
    fix = "give the acceleration of one count, for example '2.34e-6 m/s^2' for a sensitivity of 427350 counts/(m/s^2)"
    issues.append(Issue("unit", problem, typed or None, fix))
    return None


def _unit(column: Column, unit: str | None, issues: list[Issue]) -> tuple[float, str] | None:
    known = ", ".join(ACCELERATION_UNITS)
    try:
        given = checked_unit(unit) if unit else None
    except FileError as error:
        issues += error.issues
        return None
    if not column.unit:
        if given is None:
            issues.append(Issue("unit", "the file does not state its unit of acceleration", fix=f"choose one of {known}"))
        return None if given is None else (units.factor(given), given)
    try:
        stated = checked_unit(column.unit)
    except FileError:
        problem = "the file states a unit that is not a unit of acceleration"
        issues.append(Issue("unit", problem, column.unit, f"give the record in one of {known}"))
        return None
    if given and units.factor(given) != units.factor(stated):
        issues.append(Issue("unit", f"the file states {stated}", given, "leave the unit empty, or correct the file"))
    return units.factor(stated), stated


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

    A small peak that the header states too is right, and so is one whose quantity and unit the format states: an aftershock or
    a far station. A stated peak has the unit of the samples: it does not confirm a peak above that of any record.
    """
    pga = float(np.max(np.abs(acceleration))) / STANDARD_GRAVITY
    if 0 < pga <= LARGEST_PGA and (peak_agrees or stated or pga >= LEAST_PGA):
        return
    problem = f"given as {unit} the record peaks at {pga:.3g} g, outside {LEAST_PGA} to {LARGEST_PGA:g} g"
    if pga == 0:
        raise MotionError(Issue("file", "the record is zero throughout", fix="choose another record or channel"))
    other = _better_unit(pga, unit) if unit in units.UNITS else None
    fix = f"looks like {other} given as {unit}: choose the unit" if other else "check the record and its unit"
    raise MotionError(Issue("unit", problem, unit, fix))


def _better_unit(pga: float, unit: str) -> str | None:
    """The most common unit in which the record would peak between 0.02 g and 3 g."""
    for other in ("g", "cm/s^2", "m/s^2", "mm/s^2"):
        if other != unit and 0.02 <= pga * units.factor(other) / units.factor(unit) <= 3:
            return other
    return None
