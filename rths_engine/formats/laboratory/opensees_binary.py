"""Binary recorder of OpenSees (`-binary`): rows of float64 values, a line feed after every row."""

from __future__ import annotations

import sys

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.laboratory.opensees_xml import FIRST_ROW, UNITLESS
from rths_engine.formats.source import Source
from rths_engine.formats.table import MOST_COLUMNS, Column, Table, refuse_many
from rths_engine.foundation.errors import FileError, Issue

# by definition
_BYTES = 8  # of a float64 value
_LINE_FEED = 0x0A

_LEAST_ROWS = 8  # by which the line feeds cannot be chance; chosen, see docs/decisions/0023


def looks_like(source: Source) -> bool:
    """Whether the content is binary and divides into rows of values that end with a line feed."""
    return not source.head_lines and _width(source) is not None


def read(source: Source) -> Table:
    """The columns, without names, step and units. Raises FileError for content that does not divide into rows."""
    width = _width(source)
    if width is None:
        fix = "record as text, with `-file` and `-precision 16`"
        raise FileError(Issue("file", "does not divide into rows of values that end with a line feed", fix=fix))
    refuse_many(source.size // _BYTES)
    raw = np.frombuffer(source.bytes(), dtype=np.uint8).reshape(-1, width * _BYTES + 1)
    bad = np.flatnonzero(raw[:, -1] != _LINE_FEED)
    if len(bad):
        raise FileError(Issue(f"row {bad[0] + 1}", "does not end with a line feed", fix="record it again, as text"))
    values = np.ascontiguousarray(raw[:, :-1]).view("<f8" if sys.byteorder == "little" else "=f8").astype(float)
    columns = tuple(Column(f"column {k + 1}", np.ascontiguousarray(values[:, k])) for k in range(width))
    return Table("OpenSees recorder (binary)", columns, named=False, notes=(UNITLESS, FIRST_ROW))


def _width(source: Source) -> int | None:
    """The number of values in a row: the smallest for which every row of the head ends with a line feed."""
    head = np.frombuffer(source.head, dtype=np.uint8)
    for width in range(1, MOST_COLUMNS + 1):
        length = width * _BYTES + 1
        if source.size % length or source.size < _LEAST_ROWS * length:
            continue
        ends = head[length - 1 :: length]
        if len(ends) and bool(np.all(ends == _LINE_FEED)):
            return width
    return None


FORMAT = Format(
    key="opensees-binary",
    title="OpenSees recorder (binary)",
    of="measurement",
    extensions=("bin", "out"),
    defined="OpenSees, BinaryFileStream",
    header="none; neither time, names nor units: they are asked for",
    compared="line feed at the end of every row",
    looks_like=looks_like,
    read=read,
    public_check="one file written by OpenSees 3.7.1, equal to the values that the program returned",
)
