"""Sections of a CSMIP file: text lines, integer and real values of one channel, and the lines below them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rths_engine.formats.statement import Written
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.orientation import degrees, of_channel, oriented
from rths_engine.foundation.errors import FileError, Issue

END = re.compile(r"^\s*(?:/&|-*\s*End[- ]of[- ]data)", re.IGNORECASE)
_ONLY_NUMBERS = re.compile(r"^[-+.\d\s]*\d[-+.\d\s]*$")
_STATION = re.compile(r"^\s*Station (?:No\.|Id\.|USC#)\s*(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"^\s*COMP\s+(.*?)(?:\s{2,}|$)", re.IGNORECASE)
# columns, lines, places in the header and the value for "unknown", by definition of the format
_INTEGERS = fortran.Columns(16, 5)
_REALS = fortran.Columns(8, 10)
_INTEGER_LINES = 7  # 100 values, 16 a line
_WHOLE_CIRCLE = 360
_UNKNOWN = -999.0
_DIRECTION = 27  # integer header: azimuth of the sensor


@dataclass(frozen=True, slots=True)
class Header:
    """Text lines, integer and real values of a channel; the values are empty where the file has none."""

    text: list[fortran.Line]
    integers: list[str]
    reals: list[str]
    at: int

    def integer(self, number: int) -> Written | None:
        """Integer header `number`, from 1; None where it is 0 or unknown."""
        return self._of(self.integers, number, "integer")

    def real(self, number: int) -> Written | None:
        """Real header `number`, from 1; None where it is unknown."""
        return self._of(self.reals, number, "real")

    def _of(self, values: list[str], number: int, kind: str) -> Written | None:
        if number > len(values) or fortran.number(values[number - 1]) == _UNKNOWN:
            return None
        written = fortran.stated(values[number - 1], f"{kind} header {number} (from line {self.at})")
        return None if kind == "integer" and written.value == 0 else written

    def find(self, pattern: str) -> Iterator[tuple[str, re.Match[str]]]:
        """Where `pattern` stands in the text, and each match."""
        for at, line in self.text:
            if found := re.search(pattern, line, re.IGNORECASE):
                yield f"line {at}", found

    @property
    def direction(self) -> str:
        """The direction of the channel by the text: `Chan  1: 90 Deg` or `COMP N08W`."""
        lines = [line for _, line in self.text]
        component = next((found[1] for line in lines if (found := _COMPONENT.match(line))), "")
        return of_channel(lines) or component

    @property
    def station(self) -> tuple[str, str]:
        """Number and name of the station; the name stands in the line below the number."""
        for (_, line), (_, below) in zip(self.text, self.text[1:], strict=False):
            if found := _STATION.match(line):
                number = "" if re.search(r"\d+\.\d+[NS]", found[1]) else found[1]
                return number, re.split(r"\s{3,}", below.strip())[0]
        return "", ""

    @property
    def name(self) -> str:
        """Name of the channel: station and direction."""
        number, name = self.station
        return f"{number or name} {oriented(self.direction)}".strip()

    @property
    def about(self) -> dict[str, str]:
        """Event, station and both as title."""
        station = self.station[1]
        lines = (found[0].strip() for _, found in self.find(r"^.*\bearthquake\b.*$"))
        event = next((re.split(r"\s{3,}", line)[0] for line in lines), "")[:80]
        return {"title": ", ".join(part for part in (event, station) if part), "event": event, "station": station}

    @property
    def shown(self) -> str:
        """The text lines."""
        return "\n".join(line for _, line in self.text)

    def check_azimuth(self) -> None:
        """Raises FileError where the azimuth of the integers and of the text differ; 0 and 360 are one direction."""
        coded, named = self.integer(_DIRECTION), degrees(self.direction)
        if coded is not None and named is not None and int(coded.value) not in (named, named % _WHOLE_CIRCLE):
            problem = f"states an azimuth of {coded.value:g} deg; the text states {named} deg"
            raise FileError(Issue(coded.where, problem, fix="correct the azimuth that is wrong"))


def sections(lines: list[str]) -> list[list[fortran.Line]]:
    """The lines of each channel, without blank lines around them and without the line that ends its data."""
    found: list[list[fortran.Line]] = [[]]
    for at, line in enumerate(lines, start=1):
        if END.match(line):
            found.append([])
        elif line.strip() or found[-1]:
            found[-1].append((at, line))
    return [part for one in found if (part := _stripped(one))]


def _stripped(lines: list[fortran.Line]) -> list[fortran.Line]:
    last = len(lines)
    while last and not lines[last - 1][1].strip():
        last -= 1
    return lines[:last]


def header(lines: list[fortran.Line], real_lines: int) -> Header:
    """The header on `lines`, which end with 7 lines of integers and `real_lines` lines of reals, or have no values.

    Raises FileError where the values are not as many lines as the format has.
    """
    tail = len(lines)
    while tail and _ONLY_NUMBERS.match(lines[tail - 1][1]):
        tail -= 1
    numeric = len(lines) - tail
    if not numeric:
        return Header(lines, [], [], 0)
    if numeric != _INTEGER_LINES + real_lines:
        problem = f"starts {numeric} lines of header values; the format has {_INTEGER_LINES} and {real_lines}"
        raise FileError(Issue(f"line {lines[tail][0]}", problem, fix="get the file again"))
    middle = tail + _INTEGER_LINES
    integers, reals = fortran.header(lines[tail:middle], _INTEGERS), fortran.header(lines[middle:], _REALS)
    return Header(lines[:tail], integers, reals, lines[tail][0])
