"""SMC of the U.S. Geological Survey: 11 lines of text, 48 integers, 50 reals, comments, then 8 values a line.

The unit is cm/s^2, cm/s or cm by the quantity in line 1. Where no sampling rate is stated, pairs of time and value follow.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count, peak
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.pairs import uniform_step
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_FIRST = re.compile(
    r"^\s*(?:[01]\s+UNCORRECTED (ACCELEROGRAM)|2\s+CORRECTED (ACCELEROGRAM)|3\s+(VELOCITY)|4\s+(DISPLACEMENT)|0\s+(UNKNOWN)"
    r"|[56]\s+.*SPECTR)"
)
_QUANTITIES = (("acceleration", "cm/s^2"), ("acceleration", "cm/s^2"), ("velocity", "cm/s"), ("displacement", "cm"), ("", ""))
# lines, columns and places in the header: by definition of the format
_TEXT, _INTEGER_LINES, _REAL_LINES = 11, 6, 10
_INTEGERS, _REALS = fortran.Columns(8, 10), fortran.Columns(5, 15)
_VALUES, _LONG = fortran.Columns(8, 10), fortran.Columns(5, 14)  # of 5 digits; of 8 digits by integer header 47
# integer headers: value for unknown, vertical and horizontal direction (deg), comment lines, numbers of data, digits
_UNKNOWN, _VERTICAL, _AZIMUTH, _COMMENTS, _COUNT, _DIGITS = 1, 13, 14, 16, 17, 47
_RATE, _EXTREMES = 2, ((29, 30), (31, 32))  # real headers: samples/s; time and value of maximum and minimum
_LARGE = 1e38  # real values above it mean "unknown"
_STRAIGHT = {0: "up", 180: "down"}
_MARKS = re.compile(r"^\|")


@dataclass(frozen=True, slots=True)
class _Header:
    text: list[str]
    integers: list[str]
    reals: list[str]

    def integer(self, number: int) -> int | None:
        """Integer header `number`, from 1; None where it is unknown."""
        value = self.integers[number - 1]
        return None if number != _UNKNOWN and value == self.integers[0] else int(fortran.number(value))

    def real(self, number: int) -> Written | None:
        """Real header `number`, from 1; None where it is unknown."""
        written = Written.of(self.reals[number - 1], f"real header {number}")
        return None if written.value > _LARGE else written

    def named(self, pattern: str) -> str:
        return next((found[1].strip() for line in self.text if (found := re.search(pattern, line))), "")


def looks_like(source: Source) -> bool:
    """Whether the file is an SMC file."""
    lines = source.head_lines
    return len(lines) > _TEXT and bool(_FIRST.match(lines[0])) and lines[1].strip() == "*"


def read(source: Source) -> Table:
    """The record in an SMC file. Raises FileError with the line of what does not follow the format."""
    lines = source.lines
    first = _FIRST.match(lines[0])
    if first is None or first.lastindex is None:
        raise FileError(Issue("line 1", "contains response spectra", lines[0].strip(), "give the record of acceleration"))
    quantity, unit = _QUANTITIES[first.lastindex - 1]
    head = _header(lines)
    start = _TEXT + _INTEGER_LINES + _REAL_LINES + (head.integer(_COMMENTS) or 0)
    rows = list(enumerate(lines[start:], start=start + 1))
    if misplaced := next((at for at, line in rows if _MARKS.match(line)), None):
        problem = f"is a comment; integer header 16 states {head.integer(_COMMENTS)} lines of comments"
        raise FileError(Issue(f"line {misplaced}", problem, fix="get the file again"))
    layout = _LONG if head.integer(_DIGITS) == 8 else _VALUES
    stated, rate = head.integer(_COUNT), head.real(_RATE)
    if rate is not None and rate.value <= 0:
        raise FileError(Issue(rate.where, "states a sampling rate that is not positive", rate.value, "correct the header"))
    where = f"integer header {_COUNT} (from line {_TEXT + 1})"
    if rate is None and stated is not None:  # what film records have below the stated numbers is no part of them
        rows = rows[: -(-stated // layout.per_line)]
    data = fortran.series(rows, layout)
    statements = [] if stated is None else [count(stated, len(data.values), where)]
    values, dt = data.values, None if rate is None else float(f"{1 / rate.value:.9g}")
    if statements and statements[0].agrees and len(values):
        if dt is None:
            values, dt = values[1::2], uniform_step(values[::2], 0.0, f"line {start + 1}")
        statements += _compared(head, values, data.rounding, unit, dt)
    code, station = lines[2].strip(" *"), head.named(r"station\s*=\s*(.*?)\s*component")
    event = re.sub(r"^\s*(?:\d+\s+){4}", "", lines[3]).strip(" *")
    column = Column(f"{code} {_direction(head)}".strip(), values, unit, dt, quantity=quantity)
    title = ", ".join(part for part in (event, station) if part)
    about = {"title": title, "event": event, "station": station}
    return Table("SMC", (column,), statements=tuple(statements), header="\n".join(lines[:start]), about=about)


def _header(lines: list[str]) -> _Header:
    """Text, integers and reals. Raises FileError where they are not as many as the format has."""
    numbered = list(enumerate(lines, start=1))
    middle, end = _TEXT + _INTEGER_LINES, _TEXT + _INTEGER_LINES + _REAL_LINES
    integers = fortran.header(numbered[_TEXT:middle], _INTEGERS)
    reals = fortran.header(numbered[middle:end], _REALS)
    if len(integers) != 48 or len(reals) != 50:
        problem = f"starts {len(integers)} integers and {len(reals)} reals; the format has 48 and 50"
        raise FileError(Issue(f"line {_TEXT + 1}", problem, fix="get the file again"))
    return _Header(lines[:_TEXT], integers, reals)


def _direction(head: _Header) -> str:
    """`up`, `down` or the azimuth. Raises FileError where integers and text state different azimuths."""
    vertical, azimuth = head.integer(_VERTICAL), head.integer(_AZIMUTH)
    text = head.named(r"component\s*=\s*(\S+)")
    if vertical in _STRAIGHT and not text.isdigit():
        return _STRAIGHT[vertical]
    if azimuth is not None and text.isdigit() and azimuth % 360 != int(text) % 360:
        problem = f"states an azimuth of {azimuth} deg; the text states {text} deg"
        raise FileError(Issue(f"integer header {_AZIMUTH}", problem, fix="correct the azimuth that is wrong"))
    return f"{int(text)} deg" if text.isdigit() else text.lower() or ("" if azimuth is None else f"{azimuth} deg")


def _compared(head: _Header, values: Array, rounding: float, unit: str, dt: float) -> Iterator[Statement]:
    """Maximum and minimum with their times, and the peak in the text."""
    extremes = zip(("maximum", "minimum"), _EXTREMES, (float(np.max(values)), float(np.min(values))), strict=True)
    for what, (time_at, value_at), read in extremes:
        value, time = head.real(value_at), head.real(time_at)
        if value is not None:
            within = value.within + rounding
            yield Statement(what, value.where, value.value, read, unit, within)
        if value is not None and time is not None:
            times = np.flatnonzero(values == read) * dt
            at = float(times[np.argmin(np.abs(times - time.value))])
            yield Statement(f"time of the {what}", time.where, time.value, at, "s", time.within + dt)
    for number, line in enumerate(head.text, start=1):
        if found := re.search(rf"\bpk(?: \w+)?\s*=\s*({NUMBER})", line):
            yield peak(Written.of(found[1], f"line {number}"), values, unit, rounding)


FORMAT = Format(
    key="smc",
    title="SMC (U.S. Geological Survey)",
    of="ground motion",
    extensions=("smc",),
    defined="USGS National Strong-Motion Project, SMC format",
    header="quantity, sampling rate, station, azimuth, event",
    compared="number of values, maximum, minimum and their times, peak, azimuth; times of pairs are uniform",
    looks_like=looks_like,
    read=read,
    public=11,
    public_check="number of values, maximum, minimum and their times in the files; an independent parse of 9 of them",
)
