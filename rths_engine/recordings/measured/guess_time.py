"""The time column of a file: by name, else by equal steps; a sample number is never time."""

from __future__ import annotations

import numpy as np

from rths_engine.formats import few_digits
from rths_engine.formats.plain import time_columns
from rths_engine.formats.table import Column
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.guess_progress import MARK, Progress
from rths_engine.recordings.measured.guess_units import by_hint
from rths_engine.recordings.measured.roles import to_si

# chosen; see docs/decisions/0023
_AGREES = 1e-3  # between the step of the column and the step that the file states

SEVERAL = "one of several time columns with other times: map the one that belongs to the channels as t"


def choose(progress: Progress) -> None:
    """Take one time column, and leave out further time columns and sample numbers."""
    for column in progress.table.columns:
        said = progress.said.get(column.name)
        timed = said is not None and not said.unit and (said.role == "t" or not said.role)
        if timed and column.name not in progress.left and counts(column.values):
            first = ", ".join(f"{value:.0f}" for value in column.values[:3])
            progress.taken.pop(column.name, None)
            progress.left[column.name] = f"counts {first} ...: a sample number, not a time with a unit"
    called = progress.of("t")
    rising = [name for name in called if _rises(progress.table.names[name].values)]
    called, rising = _of_other_clocks(progress, called, rising)
    if not called and len(progress.table.columns) > 1:
        found = next((one for one in progress.unclear() if _rises(one.values, equally=True)), None)
        if found is not None:
            progress.take(found.name, "t", f"{MARK}: increases by equal steps")
            called = [found.name]
    if called:
        _steps(progress, (rising or called)[0])
    else:
        progress.step = progress.seconds = next((one.dt for one in progress.table.columns if one.dt), 0.0)
    _other_times(progress, (rising or called)[0] if called else "")


def _of_other_clocks(progress: Progress, called: list[str], rising: list[str]) -> tuple[list[str], list[str]]:
    """Leave out every time column but the first; all, where they are different clocks and the file assigns none of them."""
    if not called:
        return called, rising
    first = progress.table.names[(rising or called)[0]]
    others = [progress.table.names[name] for name in called if name != first.name]
    different = [one for one in others if one.name in rising and not time_columns.same(first, one)]
    assigned = {one.time for one in progress.table.columns if one.time}
    if any(len(one.values) == len(first.values) and one.name not in assigned for one in different) and not assigned:
        listed = " and ".join(one.name for one in (first, *different))
        for one in (first, *others):
            progress.left[one.name] = SEVERAL
        progress.notes.append(f"{listed} are times of different clocks: map as t the one that belongs to the channels")
        return [], []
    for one in others:
        of = [each.name for each in progress.table.columns if each.time == one.name]
        progress.left[one.name] = f"the time of {', '.join(of)}" if of else "a second time column"
    return called, rising


def _other_times(progress: Progress, name: str) -> None:
    """Leave out columns that were measured at other times than the time column, or than the first column with a step."""
    columns = [one for one in progress.table.columns if one.name not in progress.left]
    spans = {one.name: span for one in columns if (span := _span(progress, one, name)) is not None}
    first = next(iter(spans.values()), None)
    for other, (begin, end) in spans.items():
        if first is not None and (begin > first[1] or end < first[0]):
            own, others = (f"from {a:.6g} to {b:.6g}" for a, b in ((begin, end), first))
            progress.left[other] = f"was measured {own}, the first columns {others}: import it apart from them"


def _span(progress: Progress, column: Column, name: str) -> tuple[float, float] | None:
    """First and last time of a column, where the file states them on the clock of the time column `name`."""
    if column.name == name or column.time:
        times = progress.table.names.get(column.time or name)
        if times is None or times.unit != (progress.table.names[name].unit if name else times.unit):
            return None
        return (float(np.min(times.values)), float(np.max(times.values))) if np.isfinite(times.values).all() else None
    return None if name or not column.dt else (column.start, column.start + (len(column.values) - 1) * column.dt)


def unit_of(progress: Progress, name: str) -> tuple[str, str]:
    """The unit of a time column by the rate that the file states, and why; else empty, with the rates of s and ms."""
    unit, why = by_hint("time", progress.table.hints)
    if unit:
        return unit, why
    stated = progress.table.names[name].dt
    if progress.step <= 0:
        return "", "the file states no unit of time: choose it"
    rates = {unit: 1 / (progress.step * to_si(unit)[0]) for unit in ("s", "ms")}
    for unit, rate in rates.items():
        if stated and abs(rate * stated - 1) < _AGREES:
            return unit, f"in {unit} it has the rate of {rate:.6g} Hz that the file states"
    offered = ", ".join(f"{unit} would give {rate:.6g} Hz" for unit, rate in rates.items())
    return "", f"the file states no unit of time: choose it; {offered}"


def counts(values: Array) -> bool:
    """Whether the values are whole numbers that increase by one, from 0 or 1."""
    return len(values) > 2 and values[0] in (0, 1) and bool((np.diff(values) == 1).all())


def _steps(progress: Progress, name: str) -> None:
    times, taken = progress.table.names[name].values, progress.taken[name]
    steps = np.diff(times[np.isfinite(times)])
    progress.step = float(np.median(steps)) if len(steps) else 0.0
    if not taken.unit and not taken.written.problem:
        taken.unit, why = unit_of(progress, name)
        taken.why = f"{taken.why}; {why}"
    progress.seconds = progress.step * taken.scale * to_si(taken.unit)[0] if taken.unit else 0.0
    for column in progress.table.columns:
        if len(column.values) != len(times) and not (column.dt or column.time) and column.name not in progress.left:
            progress.left[column.name] = f"has {len(column.values)} samples, the time {len(times)}"


def _rises(values: Array, equally: bool = False) -> bool:
    steps = np.diff(values)
    if len(steps) < 2 or not np.isfinite(steps).all():
        return False
    if (steps > 0).all() and (not equally or float(np.ptp(steps)) < 0.5 * float(np.median(steps))):
        return True
    return few_digits.equal_steps(values) is not None
