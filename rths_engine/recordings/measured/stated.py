"""The unit that a file states for a column, beside the unit that a mapping gives it."""

from __future__ import annotations

import math

from rths_engine.formats.table import Column, Table
from rths_engine.foundation import units
from rths_engine.foundation.unit_names import Written
from rths_engine.recordings.measured import names
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.mapping import ColumnMap, Mapping

STEP_AGREES = 1e-3  # relative: rounding of a step in a header; chosen, see docs/decisions/0023


def unit_of(column: Column) -> Written:
    """The unit that the file states for a column: beside its name, or certainly in its name."""
    said = names.read(column.name, column.unit)
    return said.written


def differing(table: Table, mapping: Mapping) -> list[Finding]:
    """A warning for each column whose unit or step in the file differs from the mapping's, or whose unit is not known."""
    found = contradicting(table, mapping)
    for channel in mapping.channels:
        column = table.column(channel.column, "")
        written = unit_of(column)
        if written.problem and column.unit:
            problem = f"{written.problem}; the mapping takes {_of(column)} as {channel.unit}"
            found.append(Finding("warning", _key(channel, column), problem, written.text, fix="check the unit and the gain"))
    return found


def contradicting(table: Table, mapping: Mapping) -> list[Finding]:
    """A warning for each column of which the file states a known unit, or a step, other than the mapping's."""
    found = []
    for channel in mapping.channels:
        column = table.column(channel.column, "")
        written, key = unit_of(column), _key(channel, column)
        if written.unit and not _same(written, channel):
            problem = f"the file states {written.text} for {_of(column)}; the mapping says {channel.unit}"
            found.append(Finding("warning", key, problem, fix=f"choose {written.unit}, unless the file is wrong"))
        step = mapping.step_of(channel)
        if step is not None and column.dt is not None and abs(step - column.dt) > STEP_AGREES * step:
            problem = f"the file states a time step of {column.dt:.7g} s for {_of(column)}; the mapping says {step:.7g} s"
            found.append(Finding("warning", key, problem, fix="leave out dt and rate, unless the file is wrong"))
    return found


def _key(channel: ColumnMap, column: Column) -> str:
    return f"t ({column.name})" if channel.role == "t" else channel.key


def _of(column: Column) -> str:
    return f"column '{column.name}'"


def _same(written: Written, channel: ColumnMap) -> bool:
    """Whether the mapping gives the unit of the file, in another spelling or by a factor as its gain."""
    if channel.unit == written.unit:
        return True
    if units.dimension(channel.unit) != written.dimension or channel.unit in units.ZEROS or written.unit in units.ZEROS:
        return False
    return math.isclose(units.factor(channel.unit), written.scale * units.factor(written.unit), rel_tol=1e-9)
