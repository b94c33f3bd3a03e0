"""GeoNet volumes 1 and 2 (New Zealand, `.V1A` and `.V2A`): three components one after another.

A component has 16 lines of text, 40 integers, 60 reals, then acceleration (mm/s^2) and, in volume 2, velocity (mm/s) and
displacement (mm), ten values a line. Volume 2 counts the time of a peak without the seconds that are prepended to the series.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime, timedelta, timezone

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count, duration, peak, peak_time, step
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import Keyed, numbered, stamp
from rths_engine.formats.strong_motion.orientation import named_once
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import FileError, Issue

_FIRST = re.compile(r"^(Uncorrected|Corrected) accelerogram \S", re.IGNORECASE)
# lines, columns and places in the header, by definition of the format
_TEXT, _INTEGER_LINES, _REAL_LINES = 16, 4, 6
_HEADER = _TEXT + _INTEGER_LINES + _REAL_LINES
_INTEGERS, _REALS, _VALUES = fortran.Columns(10, 8), fortran.Columns(10, 8), fortran.Columns(10, 8)
# integer headers: direction (deg); year, month, day, hour, minute, ms of the first sample. Real headers (s)
_DIRECTION, _CLOCK = 28, (9, 10, 19, 20, 39, 40)
_PREPENDED, _LENGTH, _STEP = 22, 24, 26
# quantity, unit as written and as named here, integer header of the count, label, real headers of the peak in volumes 1 and 2
_BLOCKS = (
    ("acceleration", "mm/s/s", "mm/s^2", 34, "Acceleration", {"uncorrected": 31, "corrected": 36}),
    ("velocity", "mm/s", "mm/s", 35, "Velocity", {"corrected": 41}),
    ("displacement", "mm", "mm", 36, "Displacement", {"corrected": 46}),
)
_BEARING = re.compile(r"^([NS])(\d+)([EW])$")


def looks_like(source: Source) -> bool:
    """Whether the file is of GeoNet."""
    first = source.head_lines[:_TEXT]
    return len(first) == _TEXT and bool(_FIRST.match(first[0])) and first[1].startswith("Site ") and "Component" in first[12]


def read(source: Source) -> Table:
    """Every block of every component as a column. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    while lines and not lines[-1][1].strip():
        lines.pop()
    first, columns, statements, at = Keyed(lines[:_TEXT]), [], [], 0
    start: datetime | None = None
    while at < len(lines):
        component = _Component(lines[at : at + _HEADER])
        start = start or component.start
        at += _HEADER
        for column, said, used in component.blocks(lines[at:]):
            columns.append(column)
            statements += said
            at += used
    event, station = first.lines[6][1].strip(), first.lines[2][1].strip()
    about = {
        "title": ", ".join(part for part in (event, station) if part),
        "event": event,
        "station": station,
        "start": stamp(start),
    }
    header = "\n".join(line for _, line in lines[:_HEADER])
    return Table("GeoNet", named_once(columns), statements=tuple(statements), header=header, about=about)


class _Component:
    """The header of a component. Raises FileError where it does not have the lines and values of the format."""

    def __init__(self, lines: list[fortran.Line]) -> None:
        found = _FIRST.match(lines[0][1])
        if found is None or len(lines) < _HEADER:
            problem = "is not the first line of a component"
            fix = "get the file again: the header states fewer values than stand above, or the file is cut"
            raise FileError(Issue(f"line {lines[0][0]}", problem, lines[0][1].strip(), fix))
        self.volume = found[1].lower()
        self.text = Keyed(lines[:_TEXT])
        middle = _TEXT + _INTEGER_LINES
        self.integers = fortran.header(lines[_TEXT:middle], _INTEGERS)
        self.reals = fortran.header(lines[middle:], _REALS)
        self.at = lines[_TEXT][0]
        if len(self.integers) != 40 or len(self.reals) != 60:
            problem = f"starts {len(self.integers)} integers and {len(self.reals)} reals; the format has 40 and 60"
            raise FileError(Issue(f"line {self.at}", problem, fix="get the file again"))
        self.direction = self.text.text(r"^Component\s+(\S+)")
        self.name = " ".join((self.text.text(r"^Site (\S+)"), self.direction))
        self._check_direction()
        self._check_unit()
        self._check_count()

    def integer(self, number: int) -> int:
        return int(fortran.number(self.integers[number - 1]))

    def real(self, number: int) -> Written:
        return Written.of(self.reals[number - 1], f"real header {number} (from line {self.at})")

    @property
    def start(self) -> datetime | None:
        """The time of the first sample (UTC)."""
        year, month, day, hour, minute, milliseconds = (self.integer(one) for one in _CLOCK)
        try:
            began = datetime(year, month, day, hour, minute, tzinfo=timezone.utc)  # noqa: UP017
        except ValueError:
            return None
        return began + timedelta(milliseconds=milliseconds) - timedelta(seconds=self._prepended)

    @property
    def _prepended(self) -> float:
        return self.real(_PREPENDED).value if self.volume == "corrected" else 0.0

    def blocks(self, lines: list[fortran.Line]) -> Iterator[tuple[Column, list[Statement], int]]:
        """The columns of the component, what is stated about each, and the lines that each takes."""
        dt, at = self.real(_STEP).value, 0
        if dt <= 0:
            raise FileError(Issue(self.real(_STEP).where, "needs a step in seconds", f"{dt:g}", "correct the header"))
        for quantity, written, unit, counted, label, peaks in _BLOCKS:
            if not (stated := self.integer(counted)):
                continue
            used = -(-stated // _VALUES.per_line)
            data = fortran.series(lines[at : at + used], _VALUES)
            at += used
            of = f"{self.name} {quantity}"
            said = [count(stated, len(data.values), f"integer header {counted} (from line {self.at})", of)]
            if len(data.values):
                said += self._compared(data, label, written, dt, peaks.get(self.volume), of)
            yield Column(self.name, data.values, unit, dt, quantity=quantity), said, used

    def _compared(
        self, data: fortran.Series, label: str, unit: str, dt: float, real: int | None, of: str
    ) -> Iterator[Statement]:
        """Duration and step in text and reals; peak and its time in both."""
        if label == "Acceleration":
            lengths = [Written.of(found[1], where) for where, found in self.text.find(rf"\bDuration\s+({NUMBER})\s*s")]
            for length in (*lengths, self.real(_LENGTH)):
                yield duration(length, len(data.values), dt, of)
            for where, found in self.text.find(rf"\bat (?:intervals of )?({NUMBER})\s*s(?:ec)?\b"):
                if "peak" not in found.string.lower():
                    yield step(Written.of(found[1], where), dt)
        stated = [
            (Written.of(found[1], where), Written.of(found[2], where))
            for where, found in self.text.find(rf"^{label}:\s*peak\s+({NUMBER})\s+{unit}\s+at\s+({NUMBER})\s*s")
        ]
        if real is not None:
            stated.append((self.real(real), self.real(real + 1)))
        for highest, time in stated:
            yield peak(highest, data.values, unit, data.rounding, of, signed=True)
            later = Written(time.value + self._prepended, time.within, time.where)
            yield peak_time(later, data.values, dt, of=of)

    def _check_direction(self) -> None:
        """Raises FileError where the direction of the text and of the integers differ."""
        found, coded = _BEARING.match(self.direction), self.integer(_DIRECTION)
        if found is None:
            return
        angle = int(found[2]) if found[1] == "N" else 180 - int(found[2])
        named = (angle if found[3] == "E" else -angle) % 360
        if coded % 360 != named:
            where = f"integer header {_DIRECTION} (from line {self.at})"
            problem = f"states a direction of {coded} deg; the text states {self.direction}, {named} deg"
            raise FileError(Issue(where, problem, fix="correct the direction that is wrong"))

    def _check_count(self) -> None:
        """Raises FileError where text and integers state different numbers of points."""
        coded = self.integer(_BLOCKS[0][3])
        for where, found in self.text.find(r"^Number of points\s+(\d+)"):
            if int(found[1]) != coded:
                problem = f"states {found[1]} points; integer header {_BLOCKS[0][3]} states {coded}"
                raise FileError(Issue(where, problem, fix="get the file again"))

    def _check_unit(self) -> None:
        """Raises FileError where the text states another unit than the format has."""
        for where, found in self.text.find(r"\bin units of\s+(\S+\s+\S+)"):
            if re.fullmatch(r"1\.?0*\s+mm/s/s", found[1]) is None:
                raise FileError(Issue(where, "states a unit that is not 1 mm/s/s", found[1], "get the file again"))
        for where, found in self.text.find(rf"^Acceleration:\s*peak\s+{NUMBER}\s+(\S+)"):
            if found[1] != "mm/s/s":
                raise FileError(Issue(where, "states a unit that is not mm/s/s", found[1], "get the file again"))


FORMAT = Format(
    key="geonet",
    title="GeoNet V1A and V2A",
    of="ground motion",
    extensions=("v1a", "v2a"),
    defined="GeoNet strong-motion data formats, New Zealand",
    header="unit, step, component, quantity, site, event, start (UTC) less the prepended seconds",
    compared="number of samples, duration, step, unit, direction; peak with its sign and its time for each quantity",
    looks_like=looks_like,
    read=read,
    public=13,
    public_check="number of samples, step, and peak and time of 63 blocks in the files",
)
