"""K-NET and KiK-net of NIED (Japan): a header of labelled lines, then counts, eight a line.

acceleration (gal) = (count - mean) * factor, with `Scale Factor 3920(gal)/6182761`. The mean of the whole record is removed,
because the offset of the recorder is not acceleration and `Max. Acc.` is stated without it. `Record Time` (JST) includes a
delay of 15 s: the first sample is 15 s earlier.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count, peak
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, Keyed, instant, numbered, stamp
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.errors import FileError, Issue

# by definition of the format
_DELAY = timedelta(seconds=15)  # of the record time; K-NET ASCII format, NIED
_JAPAN = 9.0  # hours ahead of UTC
_COUNTS = fortran.Columns(8, 9)

_LABEL = re.compile(
    r"^(Origin Time|Lat\.|Long\.|Depth\.|Mag\.|Station|Record Time|Sampling Freq|Duration Time|Dir\.|Scale Factor|Max\. Acc\."
    r"|Last Correction|Memo\.)"
)
_FACTOR = re.compile(r"^\s*([\d.]+)\s*\(\s*(\w+)\s*\)\s*/\s*([\d.]+)\s*$")
_DIRECTIONS = {
    "1": "N-S borehole",
    "2": "E-W borehole",
    "3": "U-D borehole",
    "4": "N-S surface",
    "5": "E-W surface",
    "6": "U-D surface",
}
_EXTENSION = re.compile(r"^(ns|ew|ud)([12]?)$")
_PLACES = {"1": "borehole", "2": "surface"}


@dataclass(frozen=True, slots=True)
class Record:
    """The record of one direction: its column, statements, header and the time of its first sample."""

    column: Column
    statements: list[Statement]
    header: Keyed
    start: datetime | None


def looks_like(source: Source) -> bool:
    """Whether the file is of K-NET or KiK-net."""
    first = source.head_lines[:FIRST_LINES]
    labels = ("Sampling Freq(Hz)", "Station Code", "Duration Time", "Scale Factor", "Max. Acc. (gal)")
    found = [any(line.startswith(label) for line in first) for label in labels]
    return found[0] and sum(found) >= 3  # a label can be missing: its line is named then


def read(source: Source) -> Table:
    """The record of each direction in the file. Raises FileError with the line of what does not follow the format."""
    return table(records(source))


def records(source: Source) -> list[Record]:
    """The records in a file of K-NET or KiK-net. Raises FileError with the line of what does not follow the format."""
    found = [_record(header, rows) for header, rows in _sections(source.lines)]
    if not found:
        raise FileError(Issue("file", "contains no counts", fix="get the file again"))
    _check_extension(source, found)
    return found


def table(found: list[Record], notes: tuple[str, ...] = ()) -> Table:
    """A column for each record; their starts count from the earliest."""
    first = found[0].header
    starts = [one.start for one in found if one.start is not None]
    columns = [one.column for one in found]
    if len(starts) == len(found):
        delays = [(one - min(starts)).total_seconds() for one in starts]
        columns = [replace(one, start=delay) for one, delay in zip(columns, delays, strict=True)]
    event = ", ".join(part for part in (_value(first, "Origin Time"), f"M {_value(first, 'Mag.')}".removesuffix("M ")) if part)
    station = ", ".join(dict.fromkeys(_value(one.header, "Station Code") for one in found))
    about = {
        "title": ", ".join(part for part in (station, event) if part),
        "event": event,
        "station": station,
        "start": stamp(min(starts, default=None)),
    }
    statements = tuple(one for record in found for one in record.statements)
    return Table("K-NET or KiK-net", distinct(columns), True, {}, notes, statements, first.shown, about)


def _sections(lines: list[str]) -> Iterator[tuple[Keyed, list[fortran.Line]]]:
    """Header and rows of counts of each record; several records can follow one another."""
    header: list[fortran.Line] = []
    rows: list[fortran.Line] = []
    for at, line in numbered(lines):
        if _LABEL.match(line):
            if rows:
                yield Keyed(header), rows
                header, rows = [], []
            header.append((at, line))
        elif line.strip():
            rows.append((at, line))
    if rows:
        yield Keyed(header), rows
    elif header:
        raise FileError(Issue(f"line {header[-1][0]}", "ends without counts", header[-1][1].strip(), "get the file again"))


def _value(header: Keyed, label: str) -> str:
    return header.text(rf"^{re.escape(label)}\s+(\S.*)$")


def _record(header: Keyed, rows: list[fortran.Line]) -> Record:
    rate = header.needed(r"^Sampling Freq\(Hz\)\s+([\d.]+)\s*Hz", "sampling frequency")
    data = fortran.series(rows, _COUNTS)
    if len(broken := np.flatnonzero(data.values % 1)):
        where, value = f"line {rows[broken[0] // _COUNTS.per_line][0]}", f"{data.values[broken[0]]:g}"
        raise FileError(Issue(where, "contains a number that is not a count", value, "get the file again"))
    factor, written = _factor(header)
    mean = float(np.mean(data.values))
    acceleration = (data.values - mean) * factor
    name = f"{_value(header, 'Station Code')} {_direction(header)}".strip()
    statements = []
    if (lasts := header.number(r"^Duration Time\(s\)\s+(\S+)")) is not None:
        statements.append(count(round(lasts.value * rate.value), len(acceleration), lasts.where, name))
    if (highest := header.number(r"^Max\. Acc\. \(gal\)\s+(\S+)")) is not None:
        statements.append(peak(highest, acceleration, "gal", of=name))
    applied = f"(counts - mean) x {written} gal; the mean, {mean:.6g} counts = {mean * factor:.4g} gal, is removed"
    column = Column(name, acceleration, "gal", 1 / rate.value, quantity="acceleration", applied=applied)
    recorded = instant(_value(header, "Record Time"), "%Y/%m/%d %H:%M:%S", "%Y/%m/%d %H:%M:%S.%f", hours=_JAPAN)
    return Record(column, statements, header, None if recorded is None else recorded - _DELAY)


def _factor(header: Keyed) -> tuple[float, str]:
    """The acceleration (gal) of one count, and the factor as it is written."""
    where, found = next(header.find(r"^Scale Factor\s+(\S.*)$"), ("header", None))
    factor = _FACTOR.match(found[1]) if found else None
    if factor is None or factor[2].lower() != "gal" or not float(factor[1]) or not float(factor[3]):
        stated = found[1].strip() if found else ""
        raise FileError(Issue(where, "does not state a scale factor in gal", stated, "write it as '3920(gal)/6182761'"))
    return float(factor[1]) / float(factor[3]), f"{factor[1]}/{factor[3]}"


def _direction(header: Keyed) -> str:
    stated = _value(header, "Dir.")
    return _DIRECTIONS.get(stated, stated)


def _check_extension(source: Source, records: list[Record]) -> None:
    """Raises FileError where the extension (`.EW1`) and the direction in the header differ."""
    found = _EXTENSION.match(source.extension)
    stated = _direction(records[0].header)
    if found is None or len(records) > 1 or not stated:
        return
    named = "-".join(found[1].upper())
    if named not in stated or (found[2] and " " in stated and _PLACES[found[2]] not in stated):
        where = next(records[0].header.find(r"^Dir\.(.*)"))[0]
        problem = f"states the direction {stated}; the file name says {named} {_PLACES.get(found[2], '')}".rstrip()
        raise FileError(Issue(where, problem, fix="correct the name of the file"))


FORMAT = Format(
    key="knet",
    title="K-NET and KiK-net",
    of="ground motion",
    extensions=("ns", "ew", "ud", "ns1", "ew1", "ud1", "ns2", "ew2", "ud2"),
    defined="K-NET ASCII format, NIED Japan",
    header="scale factor of the counts, sampling rate, direction, station, event, start (JST, 15 s before the record time)",
    compared="number of samples, peak without the mean, direction in the name of the file",
    looks_like=looks_like,
    read=read,
    public=55,
    public_check="number of samples and peak without the mean in the files",
)
