"""MTS 793 text (MultiPurpose TestWare, Basic TestWare): blocks of rows, each with its own names, units, time and date.

Blocks of the same columns are joined where the time column goes on by its own step; else each part has columns of its own,
`Force (block 2)`. A block of two rows without time, beside blocks with time, holds the extremes of the test.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.laboratory.mts_blocks import Block, Locale, parsed
from rths_engine.formats.laboratory.rows import decimal_sign, values
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_NEXT = (0.5, 1.5)  # steps from the last sample of a block to the first of the next, where time goes on
_DIGITS = 1e-7  # MTS writes eight digits
_BARS = 8  # in the first line of the format

_SECONDS = {"s", "sec", "secs", "seconds"}


@dataclass(frozen=True, eq=False)
class Part:
    """Consecutive blocks with the same columns whose time goes on."""

    first: Block
    columns: Array
    time: int | None


def looks_like(source: Source) -> bool:
    """Whether the first line is the header of MTS files, `MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A`."""
    first = (source.head_lines or [""])[0].lstrip('"')
    return first.startswith("MTS") and first.count("|") >= _BARS


def read(source: Source) -> Table:
    """The blocks of the file. Raises FileError with the line where a block does not follow its header."""
    locale, blocks, header, about = parsed(source.lines)
    blocks = [one for one in blocks if one.rows]
    if not blocks:
        raise FileError(Issue("file", "contains no block of numbers", fix="export the data of the test"))
    notes: list[str] = []
    decimal = locale.decimal or _decided(blocks, locale, notes)
    parts = [Part(block, _rows(block, locale, decimal), _time(block)) for block in blocks]
    statements = [one for part in parts for one in _statements(part)]
    timed = {name for part in parts if part.time is not None for name in part.first.names}
    extremes = [one for one in parts if one.time is None and len(one.columns) == 2 and timed & set(one.first.names)]
    parts = [one for one in parts if one not in extremes]
    for one in extremes:
        notes.append(f"line {one.first.at}: a block of two rows without time holds the extremes of the test; it is not read")
    joined = _joined(parts)
    if len(joined) < len(parts):
        notes.append(f"{len(parts)} blocks are read as {len(joined)}: their time columns go on by the step of their samples")
    if len(joined) > 1:
        why = "time does not go on between them, or the columns differ"
        notes.append(f"{len(joined)} parts are read as columns of their own: {why}")
    columns = [column for part in joined for column in _columns(part, several=len(joined) > 1)]
    return Table(
        "MTS 793 text",
        distinct(columns),
        notes=tuple(notes),
        statements=tuple(statements),
        header="\n".join(header),
        about=about,
    )


def _decided(blocks: Sequence[Block], locale: Locale, notes: list[str]) -> str:
    sign = decimal_sign([row for block in blocks for row in block.rows], locale.delimiter)
    notes.append(f"the header does not state the decimal sign; every number has {'commas' if sign == ',' else 'points'} only")
    return sign


def _rows(block: Block, locale: Locale, decimal: str) -> Array:
    width = len(block.names)
    lines = [(at, text.rstrip().rstrip(locale.delimiter or None)) for at, text in block.rows]
    table, empty = values(lines, locale.delimiter, decimal, range(width), range(width, width + 1), block.names)
    if empty.any():
        row, column = (int(one) for one in np.argwhere(empty)[0])
        raise FileError(Issue(f"line {lines[row][0]}", f"column {block.names[column]} is empty", fix="correct the line"))
    return table


def _time(block: Block) -> int | None:
    """The column of time: the first in seconds."""
    return next((k for k, unit in enumerate(block.units) if unit.lower() in _SECONDS), None)


def _statements(part: Part) -> list[Statement]:
    """Number of points, time at which the block was written, which is not before its last sample, and date."""
    block, table = part.first, part.columns
    where = f"line {block.at}"
    found = []
    if block.points is not None:
        found.append(count(int(block.points[0]), len(table), block.points[1], f"block {where}"))
    if part.time is not None and block.stamp is not None:
        last = float(table[-1, part.time])
        within = max(block.stamp - last, _DIGITS * (abs(block.stamp) + abs(last)))
        found.append(Statement("time at which the block was written", where, block.stamp, last, "s", within))
    days = next((k for k, unit in enumerate(block.units) if unit == "d" and np.all(table[:, k] == np.floor(table[:, k]))), None)
    if block.day is not None and days is not None:
        found.append(Statement("date in days since 1899-12-30", where, block.day, float(table[-1, days]), "d", 1.0))
    return found


def _joined(parts: Sequence[Part]) -> list[Part]:
    """The parts, those joined whose columns are the same and whose time goes on by the step of their samples."""
    found: list[Part] = []
    for part in parts:
        before = found[-1] if found else None
        if before is not None and _goes_on(before, part):
            found[-1] = Part(before.first, np.concatenate([before.columns, part.columns]), before.time)
        else:
            found.append(part)
    return found


def _goes_on(before: Part, part: Part) -> bool:
    alike = (before.first.names, before.first.units) == (part.first.names, part.first.units)
    if not alike or before.time is None or part.time is None or len(before.columns) < 2:
        return False
    times = before.columns[:, before.time]
    step = float(np.median(np.diff(times)))
    return step > 0 and _NEXT[0] * step < float(part.columns[0, part.time] - times[-1]) < _NEXT[1] * step


def _columns(part: Part, several: bool) -> list[Column]:
    end = f" (block at line {part.first.at})" if several else ""
    names = [(name or f"column {k + 1}") + end for k, name in enumerate(part.first.names)]
    time = "" if part.time is None or Counter(names)[names[part.time]] > 1 else names[part.time]
    quantities = ["time" if unit.lower() in _SECONDS else "" for unit in part.first.units]
    return [
        Column(name, np.ascontiguousarray(part.columns[:, k]), unit, quantity=quantity, time="" if quantity else time)
        for k, (name, unit, quantity) in enumerate(zip(names, part.first.units, quantities, strict=True))
    ]


FORMAT = Format(
    key="mts",
    title="MTS 793 text (MultiPurpose TestWare, Basic TestWare)",
    of="measurement",
    extensions=("dat", "txt"),
    defined="MTS 793 MultiPurpose TestWare manual 100-147-131, Data File Header",
    header="delimiter, decimal sign and order of dates of the locale; title, time, date, points, names and units of each block",
    compared="number of points, time and date of each block with its columns",
    looks_like=looks_like,
    read=read,
    public=34,
    public_check="every value equal to a second reader of 60 lines",
)
