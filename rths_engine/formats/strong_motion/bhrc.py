"""BHRC (Iran), volume 1: components L, V and T one after another, ten values of 13 characters a line, in g/10.

The lines of the header are cut after 70 characters, so that of 16 integers 14 remain and of 8 reals 5; only these are read.
"""

from __future__ import annotations

import re

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count, duration
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.errors import FileError, Issue

_FIRST = re.compile(r"^\* VOL1DS FILE:")
# by definition of the format
_TEXT, _NUMBERS = 13, 14  # lines of text, and of integers and reals
_VALUES = fortran.Columns(10, 13)
_END = "/&"
# of integer header 28: line and columns; of real headers 3 (duration, s), 5 (unit, g) and 9 (rate, Hz)
_COUNT, _DURATION, _UNIT, _RATE = (_TEXT + 1, 55, 60), (_TEXT + 7, 26, 39), (_TEXT + 7, 52, 65), (_TEXT + 8, 0, 13)
_TENTH = 0.1


def looks_like(source: Source) -> bool:
    """Whether the file is of BHRC, volume 1."""
    return any(_FIRST.match(line) for line in source.head_lines[:1])


def read(source: Source) -> Table:
    """Every component as a column. Raises FileError with the line of what does not follow the format."""
    lines, columns, statements = numbered(source.lines), [], []
    section: list[fortran.Line] = []
    for at, line in lines:
        if line.startswith(_END):
            column, said = _component(section)
            columns.append(column)
            statements += said
            section = []
        elif section or line.strip():
            section.append((at, line))
    if any(line.strip() for _, line in section):
        problem = f"has no line '{_END}' below it: the file is cut"
        raise FileError(Issue(f"line {lines[-1][0]}", problem, fix="get the file again"))
    header = Keyed(lines[:_TEXT])
    station, event = header.text(r"^(.*?)\s+Station\b"), header.text(r"^Origin Time\s*:\s*(\S.*)$")
    about = {
        "title": ", ".join(part for part in (event, station) if part),
        "event": event,
        "station": station,
        "origin": stamp(instant(event, "%Y/%m/%d %H:%M:%S")),
    }
    return Table("BHRC", distinct(columns), statements=tuple(statements), header=header.shown, about=about)


def _component(lines: list[fortran.Line]) -> tuple[Column, list[Statement]]:
    first = f"line {lines[0][0]}" if lines else "file"
    if len(lines) <= _TEXT + _NUMBERS or not _FIRST.match(lines[0][1]):
        fix = "get the file again: a component has 13 lines of text, 14 of header values, then data"
        raise FileError(Issue(first, "does not start a component with data", lines[0][1].strip() if lines else "", fix))
    header = Keyed(lines[:_TEXT])
    where, unit = next(header.find(r"^UNITS ARE SECONDS AND (\S+)"), (first, None))
    tenth = _value(lines, _UNIT)
    if unit is None or unit[1] != "G/10" or tenth.value != _TENTH:
        stated = unit[1] if unit else ""
        problem = f"states the unit {stated}; the values of the header state {tenth.value:g} g, and this format has G/10"
        raise FileError(Issue(where, problem, fix="correct the unit that is wrong"))
    rate, length = _value(lines, _RATE), _value(lines, _DURATION)
    if rate.value <= 0:
        raise FileError(Issue(rate.where, "needs a sampling rate in Hz", f"{rate.value:g}", "correct the header"))
    data = fortran.series(lines[_TEXT + _NUMBERS :], _VALUES, MISSING)
    component, name = header.text(r"^COMP\s+([A-Z])"), header.text(r"^(.*?)\s+Station\b")
    azimuth = header.text(rf"\b{component}\s+(\d+)\b") if component in ("L", "T") else ""
    name = f"{name} {component}{f' {azimuth} deg' if azimuth else ''}".strip()
    dt, samples = 1 / rate.value, len(data.values)
    statements = [count(int(one.value), samples, one.where, name) for one in _counts(header, lines)]
    lengths = [Written.of(found[1], at) for at, found in header.find(rf"\bDURATION\s*=\s*({NUMBER})")]
    statements += [duration(one, samples, dt, name) for one in (*lengths, length)]
    values = data.values * _TENTH
    return Column(name, values, "g", dt, quantity="acceleration", applied="g/10 x 0.1 g"), statements


def _counts(header: Keyed, lines: list[fortran.Line]) -> list[Written]:
    return [*(Written.of(found[1], at) for at, found in header.find(r"NO\. OF POINTS\s*=\s*(\d+)")), _value(lines, _COUNT)]


def _value(lines: list[fortran.Line], place: tuple[int, int, int]) -> Written:
    """A header value by its line and columns, from 0."""
    at, line = lines[place[0]]
    try:
        return Written.of(line[place[1] : place[2]].strip(), f"line {at}")
    except ValueError:
        raise FileError(Issue(f"line {at}", "needs a number in this place", line.strip(), "get the file again")) from None


FORMAT = Format(
    key="bhrc",
    title="BHRC V1 (Iran)",
    of="ground motion",
    extensions=("v1",),
    defined="BHRC, Iran Strong Motion Network, uncorrected volume 1",
    header="unit (g/10), sampling rate, component, azimuth, station, time of the earthquake",
    compared="number of samples, duration, unit; the format states no peak",
    looks_like=looks_like,
    read=read,
    public=6,
    public_check="number of samples and duration in the files; peaks of 18 components by an independent parse by fixed columns",
)
