"""CSMNC, the strong-motion network of China: 16 lines of header, then acceleration, eight values a line."""

from __future__ import annotations

import re

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count, duration, peak, peak_time
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.strong_motion.units_written import gal_only
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import FileError, Issue

_COUNTS = rf"NO\. OF POINTS:\s*(\d+)\s+EQUALLY SPACED INTERVALS OF:\s*({NUMBER})\s*SEC"
_PEAK = rf"PEAK VALUE:\s*({NUMBER})\s+AT\s+({NUMBER})\s*SEC"
_VALUES = fortran.Columns(8, 13)  # by definition of the format
_ONLY_NUMBERS = re.compile(r"^[-+.\deE\s]*\d[-+.\deE\s]*$")
_CHINA = 8.0  # hours ahead of UTC, by definition


def looks_like(source: Source) -> bool:
    """Whether the file is of CSMNC."""
    return any(re.search(_COUNTS, line) for line in source.head_lines[:FIRST_LINES])


def read(source: Source) -> Table:
    """The record in the file. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    where, found = next(Keyed(lines).find(_COUNTS), ("", None))
    if found is None:
        raise FileError(Issue("header", "does not state the number of points and their interval", fix="get the file again"))
    counted = int(where.removeprefix("line "))
    first = next((at for at, line in lines[counted:] if _ONLY_NUMBERS.match(line)), len(lines) + 1)
    header, rows = Keyed(lines[: first - 1]), lines[first - 1 :]
    if next(header.find("VELOCITY|DISPLACEMENT"), None) or not next(header.find("ACCELERATION"), None):
        raise FileError(Issue("header", "does not describe a record of acceleration", fix="give the record of acceleration"))
    unit_at, stated = next(((at, one[1]) for at, one in header.find(r"UNIT:\s*(\S*)")), ("header", ""))
    unit = gal_only(stated, unit_at)
    dt = header.needed(r"INTERVALS OF:\s*(\S+)", "interval").value
    data = fortran.series(rows, _VALUES, MISSING)
    statements = [count(int(found[1]), len(data.values), where)]
    if len(data.values):
        statements += _compared(header, data, unit, dt)
    code, direction = header.text(r"^STATION:\s*(\S+)"), header.text(r"^COMP\.\s*(\S+)")
    event = header.lines[2][1].strip().rstrip(",") if len(header.lines) > 2 else ""
    started = header.text(r"RECORDER TIME:\s*(.*?)\s*BTM")
    about = {
        "title": ", ".join(part for part in (event, code) if part),
        "event": event,
        "station": code,
        "start": stamp(instant(started, "%Y-%m-%d %H:%M:%S.%f", "%Y-%m-%d %H:%M:%S", hours=_CHINA)),
    }
    column = Column(f"{code} {direction}".strip() or "acceleration", data.values, unit, dt, quantity="acceleration")
    return Table("CSMNC", (column,), statements=tuple(statements), header=header.shown, about=about)


def _compared(header: Keyed, data: fortran.Series, unit: str, dt: float) -> list[Statement]:
    """Duration, peak and its time; the network counts the time of the first sample as one step."""
    found = []
    if (lasts := header.number(rf"DURATION:\s*({NUMBER})\s*SEC")) is not None:
        found.append(duration(lasts, len(data.values), dt))
    highest, time = header.number(_PEAK), header.number(rf"PEAK VALUE:\s*{NUMBER}\s+AT\s+({NUMBER})\s*SEC")
    if highest is not None:
        found.append(peak(highest, data.values, unit, data.rounding, signed=True))
    if time is not None:
        found.append(peak_time(time, data.values, dt, start=dt))
    return found


FORMAT = Format(
    key="csmnc",
    title="CSMNC (China)",
    of="ground motion",
    extensions=("dat",),
    defined="China Strong Motion Networks Centre, uncorrected and corrected acceleration",
    header="unit, step, component, station, event, start (Beijing time)",
    compared="number of samples, duration, peak with its sign and its time",
    looks_like=looks_like,
    read=read,
    public=10,
    public_check="number of samples, duration, peak with its sign and its time in the files",
)
