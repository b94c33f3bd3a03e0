"""The time columns and sample numbers of a table of text, held against the step and the count that its header states."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rths_engine.formats import statement
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.headings import name_and_unit, quantity_of
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_SAME = 0.02  # relative: between the step of a column and a stated step; chosen, see docs/decisions/0023
_UNITS = ("s", "ms", "us", "min", "h")


@dataclass
class Timed:
    """The columns with quantity and step, and what the header states of their time."""

    columns: list[Column]
    statements: list[Statement] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def timed(columns: Sequence[Column], facts: Facts, line: Callable[[int], int], named: bool) -> Timed:
    """Mark time columns, and give the columns the step that the header states with certainty.

    Raises FileError where sample numbers have a gap, or where no unit of time fits the step that the header states.
    """
    found = Timed([])
    count = len(columns[0].values)
    dt, certain = facts.dt, True
    for k, column in enumerate(columns):
        quantity = column.quantity or time_like(column, k, named)
        if quantity == "sample number":
            certain = _numbers_follow(column, line) and certain
            quantity = ""  # a sample number is no quantity
        found.columns.append(replace(column, quantity=quantity))
    if dt is not None and not certain:
        found.notes.append("the sample numbers do not increase by one: the step that the header states may not be theirs")
        dt = None
    found.notes += [f"{text}: not used" for text in facts.unclear]
    step = dt
    for column in found.columns:
        if column.quantity == "time" and (own := _step(column, facts, found)) is not None:
            step = own
    found.columns = [replace(one, dt=dt if one.dt is None else one.dt) for one in found.columns]
    found.statements += [statement.count(round(one.value), count, one.where) for one in facts.counts]
    if step is not None:
        begin = next((_start_of(one) for one in found.columns if one.quantity == "time"), 0.0)
        found.statements += facts.duration_statements(count, step, begin)
    return found


def _start_of(column: Column) -> float:
    """The first time (s) of a time column; zero where its unit is not stated."""
    written = unit_of(column)
    known = written.dimension == "time" and len(column.values) and np.isfinite(column.values[0])
    return float(column.values[0]) * written.scale * units.factor(written.unit) if known else 0.0


def unit_of(column: Column) -> unit_names.Written:
    """The unit of a column: stated in its own row, else in its name."""
    return unit_names.read(column.unit or name_and_unit(column.name)[1])


def time_like(column: Column, index: int, named: bool) -> str:
    """Whether a column is `time` or a `sample number`; empty where it is neither."""
    if not named or column.name == f"column {index + 1}":
        return "sample number" if index == 0 and _counts(column.values) else ""
    name, unit = name_and_unit(column.name)
    quantity = quantity_of(name, column.unit or unit)
    if quantity == "sample number":
        finite = column.values[: 1 << 16]
        return quantity if np.array_equal(finite, np.rint(finite)) else ""
    return quantity if quantity == "time" else ""


def _counts(values: Array) -> bool:
    return len(values) > 2 and float(values[0]) in {0.0, 1.0} and bool((np.diff(values) == 1).all())


def _numbers_follow(column: Column, line: Callable[[int], int]) -> bool:
    """Whether sample numbers increase by one. Raises FileError where one is missing among numbers that do."""
    steps = np.diff(column.values)
    if not len(steps) or (steps == steps[0]).all():
        return bool(len(steps)) and float(steps[0]) == 1.0
    usual = float(np.median(steps))
    at = int(np.flatnonzero(steps != usual)[0]) + 1
    value = f"{column.values[at - 1]:g}, then {column.values[at]:g}"
    fix = "get the file with every sample, or correct the numbers"
    raise FileError(Issue(f"line {line(at)}", f"{column.name} does not increase by {usual:g}: samples are missing", value, fix))


def _step(column: Column, facts: Facts, found: Timed) -> float | None:
    """The step (s) of a time column where its unit is stated, compared with the step in the header."""
    values = column.values[np.isfinite(column.values)] if len(column.values) < 1 << 20 else column.values
    if len(values) < 3:
        return None
    step = float(values[-1] - values[0]) / (len(values) - 1)
    written = unit_of(column)
    if written.dimension == "time":
        step *= written.scale * units.factor(written.unit)
        if step > 0:
            found.statements += facts.step_statements(step)
        return step if step > 0 else None
    if facts.dt is None or step <= 0 or not written.none:
        return None
    if not any(abs(step * units.factor(unit) / facts.dt - 1) < _SAME for unit in _UNITS):
        problem = (
            f"states a time step of {facts.dt:.7g} s; the steps of {column.name} are {step:.7g}, in no unit of time the same"
        )
        fix = "the file contradicts itself: get it again, or correct the header or the data"
        raise FileError(Issue(facts.steps[0].where, problem, fix=fix))
    return facts.dt
