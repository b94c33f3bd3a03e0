"""catman ASCII export (HBM): one line of names with units in brackets, a time channel for each rate, then rows."""

from __future__ import annotations

import re

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import rows
from rths_engine.formats.laboratory.rows import Line
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition
_OVERFLOW = -1_000_000.0  # what catman writes for a channel without a sensor, or out of range

_TIME = re.compile(r"(Zeit|Time|Temps|Tiempo)\s+\d+ - .*\[.*\]")
_HEADING = re.compile(r"(.*?)\s*\[([^\[\]]*)\]\s*")


def looks_like(source: Source) -> bool:
    """Whether the first heading is a time channel with the name of its rate, `Time  1 - default sample rate [s]`."""
    first = re.split(r"[\t;]", (source.head_lines or [""])[0])
    return len(first) > 1 and _TIME.fullmatch(first[0].strip()) is not None


def read(source: Source) -> Table:
    """The channels of the file. Raises FileError with the line of a value out of range and of a row that does not fit."""
    lines = source.lines
    separator = "\t" if "\t" in lines[0] else ";"
    headings = [one for one in rows.fields(lines[0], separator) if one]
    data = [(at, line) for at, line in enumerate(lines[1:], start=2) if line.strip()]
    if not data:
        raise FileError(Issue("file", "contains no rows", fix="export the file again"))
    width, decimal = len(headings), rows.decimal_sign(data, separator)
    table, empty = rows.values(data, separator, decimal, range(width), range(width, width + 2), headings)
    columns: list[Column] = []
    notes: list[str] = []
    time = ""
    for k, heading in enumerate(headings):
        named = _HEADING.fullmatch(heading)
        name, unit = (" ".join(named[1].split()), named[2]) if named else (heading, "")
        values = rows.up_to_last(table[:, k], empty[:, k], data, name)
        if not len(values) or _without_sensor(values, data, name):
            notes.append(f"{name} holds no measurements")
        elif _TIME.fullmatch(heading):
            time = name
            columns.append(Column(name, values, unit, quantity="time"))
        else:
            columns.append(Column(name, values, unit, time=time))
    return Table("catman ASCII", distinct(columns), notes=tuple(notes), header=lines[0])


def _without_sensor(values: Array, data: list[Line], name: str) -> bool:
    """Whether every value is the mark. Raises FileError with the line where some values are."""
    marked = np.flatnonzero(values == _OVERFLOW)
    if 0 < len(marked) < len(values):
        problem = f"{name} is out of range: catman writes {_OVERFLOW:.0f} for it ({len(marked)} values)"
        raise FileError(
            Issue(f"line {data[int(marked[0])][0]}", problem, fix="cut the file there, or export it without the channel")
        )
    return len(marked) > 0


FORMAT = Format(
    key="catman-ascii",
    title="catman ASCII export (HBM)",
    of="measurement",
    extensions=("asc", "txt"),
    defined="catman, HBK; the headings of its files",
    header="names, units and rate of each time channel",
    compared="number of fields in every row; values out of range are refused",
    looks_like=looks_like,
    read=read,
    public=11,
    public_check="the rows of each file split by Python",
)
