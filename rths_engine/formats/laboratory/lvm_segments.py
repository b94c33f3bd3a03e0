"""Segments of a LabVIEW measurement file: their headers, one value for each column, and their rows."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime

from rths_engine.formats.laboratory.rows import Line, fields
from rths_engine.foundation.errors import FileError, Issue

# LabVIEW Measurement File Specification, National Instruments
END = "***End_of_Header***"
_SPECIAL, _END_SPECIAL = "***Start_Special***", "***End_Special***"
_LABELS = "X_Value"
_SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": " "}
_KEYS = {
    "Channels", "Samples", "Date", "Time", "Y_Unit_Label", "X_Dimension", "X_Unit_Label", "X0", "Delta_X", "Notes", "Test_Name",
    "Test_Numbers", "Test_Series", "UUT_M/N", "UUT_S/N", "UUT_Name", "Y_Dimension", "Operator", "Project", "Description",
}  # fmt: skip
_TIME = re.compile(r"(\d{1,2}):(\d{2}):(\d{2})(?:[.,](\d+))?")
_DATE = re.compile(r"(\d{4})[/.-](\d{1,2})[/.-](\d{1,2})")


@dataclass
class Segment:
    """One segment: the keys of its header with one field for each column, the labels of its columns, and its rows."""

    keys: dict[str, tuple[int, list[str]]] = field(default_factory=dict)
    labels: list[str] = field(default_factory=list)
    at: int = 0
    rows: list[Line] = field(default_factory=list)
    breaks: list[int] = field(default_factory=list)  # lines at which rows go on after an empty line without a header

    def stated(self, key: str, column: int) -> tuple[str, str]:
        """The field of a key for a column, and the line where it stands; empty where it is not stated."""
        at, given = self.keys.get(key, (0, []))
        return (given[column] if column < len(given) else ""), f"line {at}"

    def began(self, column: int) -> float | None:
        """Date and time of a channel in s since 1970."""
        date, time = _DATE.fullmatch(self.stated("Date", column)[0]), _TIME.fullmatch(self.stated("Time", column)[0])
        if date is None or time is None:
            return None
        try:
            whole = datetime(*map(int, date.groups()), *map(int, time.groups()[:3]))  # type: ignore[arg-type]
        except ValueError:
            return None
        return (whole - datetime(1970, 1, 1)).total_seconds() + float(f"0.{time[4] or 0}")


@dataclass
class File:
    """The header of the file and its segments. `notes`: what was left out."""

    header: dict[str, str]
    separator: str
    segments: list[Segment]
    text: list[str]
    notes: list[str]


def parsed(lines: Sequence[str]) -> File:
    """The segments of a file. Raises FileError with the line where rows stand without labels."""
    header, start = _header(lines)
    separator = _separator(header)
    notes: list[str] = []
    text = list(lines[:start])
    segments: list[Segment] = []
    current, ended, apart = Segment(), False, False
    special = ""
    for at, line in enumerate(lines[start:], start=start + 1):
        first = line.partition(separator)[0].strip()
        if special or first == _SPECIAL:
            text.append(line)
            notes += [] if special else [f"line {at}: a special block is not read"]
            special = "" if first == _END_SPECIAL else _SPECIAL
        elif not line.strip():
            apart = ended
        elif first == END:
            text.append(line)
            ended = True
        elif first in _KEYS and (not ended or apart or (current.labels and not current.rows)):
            if ended:
                segments, current, ended = [*segments, current], Segment(), False
            text.append(line)
            current.keys[first] = (at, fields(line, separator))
            apart = False
        elif not ended and first.startswith(_LABELS) and not current.keys:
            text.append(line)  # the file has no header of segments
            current.labels, current.at, ended = fields(line, separator), at, True
        elif not ended and re.match(r"[A-Za-z]", first):
            text.append(line)  # a key that the specification does not list, or one of the file's header without its first line
            current.keys[first] = (at, fields(line, separator))
        elif not ended:
            fix = f"each segment needs its lines of header, then {END}"
            raise FileError(Issue(f"line {at}", "stands before the end of the header", line.strip(), fix))
        elif not current.labels:
            text.append(line)
            current.labels, current.at = fields(line, separator), at
        else:
            if apart and current.rows:
                current.breaks.append(at)
            current.rows.append((at, line))
            apart = False
    return File(header, separator, [*segments, current], text, notes)


def _header(lines: Sequence[str]) -> tuple[dict[str, str], int]:
    """The keys of the file's header, and the number of its lines, 0 where a segment begins the file."""
    whole = lines[0].strip().startswith("LabVIEW Measurement")
    header: dict[str, str] = {}
    for at, line in enumerate(lines, start=1):
        if line.strip().startswith(END):
            return header, at if whole else 0
        key, _, value = re.sub(r"[\t;,]", "\t", line, count=1).partition("\t")
        header[key.strip()] = value.strip()[:1] if key == "Decimal_Separator" else value.strip(" \t;,")
    raise FileError(Issue("file", "ends inside its header", fix="get the file again"))


def _separator(header: dict[str, str]) -> str:
    stated = header.get("Separator", "Tab")
    if stated.lower() not in _SEPARATORS:
        raise FileError(Issue("Separator", "is not a known separator", stated, "export the file with tabs"))
    return _SEPARATORS[stated.lower()]
