"""Sections of a COSMOS file: text, integer and real headers of one channel, and the lines of its blocks of data."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from rths_engine.formats.lines import NUMBER
from rths_engine.formats.statement import Written
from rths_engine.formats.strong_motion import fortran
from rths_engine.foundation.errors import FileError, Issue

FIRST = re.compile(r"\(\s*Format\s+v\d+\.\d+", re.IGNORECASE)
_INTEGERS = re.compile(r"^\s*(\d+)\s+Integer-header values follow on\s+(\d+)\s+lines", re.IGNORECASE)
_REALS = re.compile(r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines", re.IGNORECASE)
_COMMENTS = re.compile(r"^\s*(\d+)\s+Comment line", re.IGNORECASE)
DATA = re.compile(r"^\s*(\d+)\s+([A-Za-z][\w. ]*?)\s*pts\s*,", re.IGNORECASE)
_END = re.compile(r"^\s*(?:/&|End[- ]of[- ]data)", re.IGNORECASE)
_UNKNOWN = re.compile(rf"unknown.*?:\s*({NUMBER})\s*,\s*({NUMBER})", re.IGNORECASE)
_STATION = re.compile(r"\bCode:\s*(\S+)\s*(?:\S+\s+)?(.*)$", re.IGNORECASE)
_UNSTATED = (-999.0,)  # COSMOS 1.20, where line 13 does not state another value


@dataclass(slots=True)
class Section:
    """The headers of one channel: text lines, integer and real values as written, where they start, and its blocks of data."""

    text: list[fortran.Line] = field(default_factory=list)
    integers: list[str] = field(default_factory=list)
    reals: list[str] = field(default_factory=list)
    integers_at: int = 0
    reals_at: int = 0
    unknown: tuple[float, ...] = _UNSTATED
    blocks: list[tuple[fortran.Line, list[fortran.Line]]] = field(default_factory=list)

    def integer(self, number: int) -> int | None:
        """Integer header `number`, from 1; None where it is not stated."""
        value = fortran.number(self.integers[number - 1]) if number <= len(self.integers) else None
        return None if value is None or value in self.unknown else int(value)

    def real(self, number: int) -> Written | None:
        """Real header `number`, from 1; None where it is not stated."""
        if number > len(self.reals) or fortran.number(self.reals[number - 1]) in self.unknown:
            return None
        where = f"real header {number} (from line {self.reals_at})"
        written = fortran.stated(self.reals[number - 1], where)
        return Written(written.value, max(written.within, 1e-6 * abs(written.value)), where)

    def line(self, pattern: str) -> tuple[str, re.Match[str]] | None:
        """Where the first line of the text stands that contains `pattern`, and the match."""
        for at, text in self.text:
            if found := re.search(pattern, text, re.IGNORECASE):
                return f"line {at}", found
        return None

    @property
    def station(self) -> tuple[str, str]:
        """Code and name of the station."""
        found = next((match for _, text in self.text if (match := _STATION.search(text))), None)
        return (found[1], re.sub(r"^[A-Z]{2}:", "", " ".join(found[2].split()))) if found else ("", "")


def sections(lines: list[str]) -> list[Section]:
    """The sections of the file. Raises FileError for a section without data and for text between data and next section."""
    found: list[Section] = []
    at, last = 0, len(lines)
    while last and not lines[last - 1].strip():
        last -= 1
    while at < last:
        section, at = _section(lines, at, last)
        found.append(section)
        while at < last and not lines[at].strip():
            at += 1
        if at < last and not FIRST.search(lines[at]):
            fix = "correct or remove it: only a further channel can follow the end of the data"
            raise FileError(Issue(f"line {at + 1}", "is not the first line of a channel", lines[at].strip(), fix))
    return found


def _section(lines: list[str], start: int, last: int) -> tuple[Section, int]:
    """The section from line `start` (from 0), and the line after it."""
    section, at = Section(), start
    while at < last and not DATA.match(lines[at]):
        line = lines[at]
        if found := _INTEGERS.match(line):
            section.integers_at, section.integers = at + 2, _values(lines, at, found)
            at += int(found[2])
        elif found := _REALS.match(line):
            section.reals_at, section.reals = at + 2, _values(lines, at, found)
            at += int(found[2])
        elif found := _COMMENTS.match(line):
            at += int(found[1])
        else:
            section.text.append((at + 1, line))
            if found := _UNKNOWN.search(line):
                section.unknown = (fortran.number(found[1]), fortran.number(found[2]))
        at += 1
    if at >= last:
        fix = "a section has '... pts, approx ... secs, units=...,Format=(...)' before its data"
        raise FileError(Issue(f"line {start + 1}", "starts a section without data", lines[start].strip(), fix))
    while at < last and DATA.match(lines[at]):
        opening = (at + 1, lines[at])
        at += 1
        rows: list[fortran.Line] = []
        while at < last and not (_END.match(lines[at]) or DATA.match(lines[at])):
            rows.append((at + 1, lines[at]))
            at += 1
        section.blocks.append((opening, rows))
    return section, at + 1


def _values(lines: list[str], at: int, found: re.Match[str]) -> list[str]:
    """Header values below line `at` (from 0), as written. Raises FileError where their number is not the stated number."""
    columns = fortran.Columns.written(lines[at]) or fortran.Columns(*((10, 8) if _INTEGERS.match(lines[at]) else (5, 15)))
    rows = list(enumerate(lines[at + 1 : at + 1 + int(found[2])], start=at + 2))
    values = fortran.header(rows, columns)
    if len(values) != int(found[1]):
        problem = f"states {found[1]} header values; the {found[2]} lines below have {len(values)}"
        raise FileError(Issue(f"line {at + 1}", problem, fix="get the file again"))
    return values
