"""The unit that a file states for a column, beside the unit that a mapping gives it."""

from __future__ import annotations

import math

from rths_engine.formats.table import Column, Table
from rths_engine.foundation import units
from rths_engine.foundation.unit_names import Written
from rths_engine.recordings.measured import names
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.mapping import ColumnMap, Mapping


def unit_of(column: Column) -> Written:
    """The unit that the file states for a column: beside its name, or certainly in its name."""
    said = names.read(column.name, column.unit)
    return said.written


def differing(table: Table, mapping: Mapping) -> list[Finding]:
    """A warning for each column whose unit in the file differs from the unit in the mapping, or is not known."""
    found = []
    for channel in mapping.channels:
        column = table.column(channel.column, "")
        written = unit_of(column)
        key = f"t ({column.name})" if channel.role == "t" else channel.key
        if written.problem and column.unit:
            problem = f"{written.problem}; the mapping takes {_of(column)} as {channel.unit}"
            found.append(Finding("warning", key, problem, written.text, fix="check the unit and the gain"))
        elif written.unit and not _same(written, channel):
            problem = f"the file states {written.text} for {_of(column)}; the mapping says {channel.unit}"
            found.append(Finding("warning", key, problem, fix=f"choose {written.unit}, unless the file is wrong"))
    return found


def _of(column: Column) -> str:
    return f"column '{column.name}'"


def _same(written: Written, channel: ColumnMap) -> bool:
    """Whether the mapping gives the unit of the file, in another spelling or by a factor as its gain."""
    if channel.unit == written.unit:
        return True
    if units.dimension(channel.unit) != written.dimension or channel.unit in units.ZEROS or written.unit in units.ZEROS:
        return False
    return math.isclose(units.factor(channel.unit), written.scale * units.factor(written.unit), rel_tol=1e-9)
