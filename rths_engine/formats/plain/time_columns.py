"""Several time columns in one table: each signal belongs to the nearest time column on its left."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rths_engine.formats.plain.headings import name_and_unit
from rths_engine.formats.table import Column
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_SAME = 0.05  # of a step: time columns that differ by less are one clock
_SINCE_EPOCH = 1e6  # s: a clock that starts later counts from a date, not from the start of the record

_FROM_FIRST = "seconds from the first"  # how `applied` begins where stamps lost their start


def assigned(columns: Sequence[Column]) -> tuple[Column, ...]:
    """The columns; where the table has several clocks, each signal with the name of its time column.

    A signal left of every time column, or right of neighbouring time columns of different clocks, gets none: it is asked for.
    A later time column that goes up and down is no time.
    """
    clocks = [one for one in columns if one.quantity == "time" and _rises(one.values)]
    if not clocks:
        return tuple(columns)
    first = next(k for k, one in enumerate(columns) if one is clocks[0])
    columns = [
        replace(one, quantity="") if k > first and one.quantity == "time" and _falls(one.values) else one
        for k, one in enumerate(columns)
    ]
    if all(same(clocks[0], one) for one in clocks[1:]):
        return tuple(columns)
    found: list[Column] = []
    beside: list[Column] = []
    signals = False
    for column in columns:
        if any(column is one for one in clocks):
            beside = [column] if signals else [*beside, column]
            signals = False
            found.append(column)
            continue
        signals = signals or column.quantity != "time"
        one_clock = bool(beside) and all(same(beside[0], one) for one in beside[1:])
        found.append(replace(column, time=beside[0].name) if one_clock and column.quantity != "time" else column)
    return tuple(_ended(found))


def refuse_untimed(columns: Sequence[Column], line: Callable[[int], int]) -> None:
    """Raises FileError where the last rows have values but no time: a footer, such as statistics."""
    clocks = [one for one in columns if one.quantity == "time"]
    ends = {_end(one.values) for one in clocks}
    if len(ends) != 1 or (end := ends.pop()) == 0 or np.isnan(clocks[0].values[:end]).any():
        return
    below = [one for one in columns if one.quantity != "time" and np.isfinite(one.values[end:]).any()]
    if below:
        row = min(end + int(np.flatnonzero(np.isfinite(one.values[end:]))[0]) for one in below)
        problem = f"has values but no {clocks[0].name}: a footer, such as statistics, or rows that are no samples"
        raise FileError(Issue(f"line {line(row)}", problem, fix="remove these rows from the file"))


def same(one: Column, other: Column) -> bool:
    """Whether two time columns are one clock: equal except for rounding, or one of them counts from a date."""
    if len(one.values) != len(other.values):
        return False
    first, second = one.values * _scale(one, other), other.values * _scale(other, one)
    if (np.isfinite(first) != np.isfinite(second)).any():
        return False
    first, second = first[np.isfinite(first)], second[np.isfinite(second)]
    if len(first) < 2:
        return True
    apart = second - first
    starts = (abs(float(first[0])), abs(float(second[0])))
    if any(each.applied.startswith(_FROM_FIRST) for each in (one, other)) or max(starts) > _SINCE_EPOCH > min(starts):
        apart = apart - float(np.median(apart))
    steps = np.abs(np.diff(first)), np.abs(np.diff(second))
    within = max(_SAME * float(np.median(steps[0])), *(float(np.max(each)) for each in steps if not each.all()), 0.0)
    return float(np.max(np.abs(apart))) <= within


def _scale(column: Column, other: Column) -> float:
    """Seconds in the unit of a time column; 1 where the two columns do not both state one."""
    written = [unit_names.read(one.unit or name_and_unit(one.name)[1]) for one in (column, other)]
    if any(one.dimension != "time" for one in written):
        return 1.0
    return written[0].scale * units.factor(written[0].unit)


def _rises(values: Array) -> bool:
    """Whether the values increase, or stay where stamps are rounded; they can end before the rows do."""
    finite = values[np.isfinite(values)]
    return len(finite) > 1 and bool((np.diff(finite) >= 0).all()) and float(finite[-1]) > float(finite[0])


def _falls(values: Array) -> bool:
    """Whether the values go down as often as a signal does, which a time that starts again does not."""
    steps = np.diff(values[np.isfinite(values)])
    return len(steps) > 1 and float(np.mean(steps < 0)) > 0.1


def _ended(columns: Sequence[Column]) -> list[Column]:
    """The columns; each clock and its signals without the empty rows below their last stamp."""
    ends: dict[str, int] = {}
    for one in columns:
        if one.quantity == "time":
            members = [each for each in columns if each is one or each.time == one.name]
            ends[one.name] = max(_end(each.values) for each in members)
    return [_cut(one, ends.get(one.time or one.name, len(one.values))) for one in columns]


def _cut(column: Column, end: int) -> Column:
    return column if end >= len(column.values) else replace(column, values=column.values[:end])


def _end(values: Array) -> int:
    """The index after the last value."""
    if len(values) and not np.isnan(values[-1]):
        return len(values)
    every = np.flatnonzero(~np.isnan(values))
    return int(every[-1]) + 1 if len(every) else 0
