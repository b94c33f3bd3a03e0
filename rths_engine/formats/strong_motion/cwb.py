"""Text of the Taiwanese network (CWB, CWA): lines `#Key: value`, then time and a column for each component."""

from __future__ import annotations

import re

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.strong_motion.units_written import gal_only
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_WIDTH = 10  # by definition of the format
_SEQUENCE = r"^#DataSequence:\s*Time\s+(.*?)\s*$"
_EXTREMES = rf"^#AmplitudeMAX\.\s*(\S+?):\s*({NUMBER})\s*~\s*({NUMBER})"
_TAIWAN = 8.0  # hours ahead of UTC, by definition
_FORMS = ("%Y/%m/%d-%H:%M:%S.%f", "%Y/%m/%d-%H:%M:%S")


def looks_like(source: Source) -> bool:
    """Whether the file is of the Taiwanese network."""
    return any(re.match(_SEQUENCE, line) for line in source.head_lines[:FIRST_LINES])


def read(source: Source) -> Table:
    """Every component as a column. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    end = next((at for at, line in lines if line.strip() and not line.startswith("#")), len(lines) + 1) - 1
    header = Keyed(lines[:end])
    where, stated = next(((where, one[1]) for where, one in header.find(r"^#AmplitudeUnit:\s*(.*)$")), ("header", ""))
    unit = gal_only(re.split(r"[.\s]", stated)[0], where)
    names = [re.sub(r"\(\+\)$", "", one.strip()) for one in header.text(_SEQUENCE).split(";")]
    rate = header.needed(r"^#SampleRate\(Hz\):\s*(\S+)", "sampling rate")
    layout = fortran.Columns.written(f"({header.text('^#Data:(.*)$')})") or fortran.Columns(1 + len(names), _WIDTH)
    if layout.per_line != 1 + len(names):
        problem = f"states {layout.per_line} columns; the sequence names {1 + len(names)}"
        raise FileError(Issue(next(header.find("^#Data:(.*)$"))[0], problem, fix="correct the header"))
    data = fortran.series(lines[end:], layout, MISSING)
    if len(data.values) % layout.per_line:
        raise FileError(Issue(f"line {lines[-1][0]}", "ends a row without all columns", fix="get the file again"))
    rows = data.values.reshape(-1, layout.per_line)
    dt = 1 / rate.value
    statements = list(_compared(header, rows, names, unit, rate))
    _check_times(rows[:, 0], dt, lines[end:])
    code = header.text(r"^#StationCode:\s*(.*)$")
    applied = "offset removed by the network" if header.text(r"^#AmplitudeUnit:(.*DCoffset\(corr\))") else ""
    columns = tuple(
        Column(f"{code} {name}".strip(), np.ascontiguousarray(rows[:, k]), unit, dt, quantity="acceleration", applied=applied)
        for k, name in enumerate(names, start=1)
    )
    event = header.text(r"^#Origin Time\S*:\s*(.*)$")
    station = header.text(r"^#StationName:\s*(.*)$") or code
    about = {
        "title": ", ".join(part for part in (event, station) if part),
        "event": event,
        "station": station,
        "start": stamp(instant(header.text(r"^#StartTime\(GMT\+08\):\s*(.*)$"), *_FORMS, hours=_TAIWAN)),
    }
    return Table("CWB (Taiwan)", columns, statements=tuple(statements), header=header.shown, about=about)


def _compared(header: Keyed, rows: Array, names: list[str], unit: str, rate: Written) -> list[Statement]:
    """Number of samples by length and rate, and the largest and smallest value of each component."""
    found = []
    if (lasts := header.number(r"^#RecordLength\(sec\):\s*(\S+)")) is not None:
        stated = round(lasts.value * rate.value)
        ends_at_length = stated + 1 == len(rows)  # the last sample stands at the stated length
        found.append(count(stated + ends_at_length, len(rows), lasts.where))
    half = 0.0005  # F10.3
    for where, one in header.find(_EXTREMES):
        if one[1] not in names:
            problem = f"states the range of {one[1]}; the sequence names {', '.join(names)}"
            raise FileError(Issue(where, problem, fix="correct the names of the components"))
        values = rows[:, 1 + names.index(one[1])]
        for what, text, read_as in (("maximum", one[2], np.max), ("minimum", one[3], np.min)):
            stated_value = Written.of(text, where)
            read_value = float(read_as(values)) if len(values) else 0.0
            found.append(
                Statement(f"{what} of {one[1]}", where, stated_value.value, read_value, unit, stated_value.within + half)
            )
    return found


def _check_times(times: Array, dt: float, lines: list[fortran.Line]) -> None:
    """Raises FileError at the first row whose time does not follow the sampling rate."""
    off = np.abs(times - (times[:1] + np.arange(len(times)) * dt))
    if len(wrong := np.flatnonzero(off > dt / 2)):
        rows = [at for at, line in lines if line.strip()]
        expected = float(times[0] + wrong[0] * dt)
        problem = f"has the time {times[wrong[0]]:g} s; the sampling rate gives {expected:g} s"
        raise FileError(Issue(f"line {rows[wrong[0]]}", problem, fix="get the file again: samples are missing or added"))


FORMAT = Format(
    key="cwb",
    title="CWB (Taiwan)",
    of="ground motion",
    extensions=("dat", "txt"),
    defined="Central Weather Administration of Taiwan, free-field text of 4F10.3",
    header="unit, sampling rate, components, station, event, start (UTC+8)",
    compared="number of samples, times of all rows, largest and smallest value of each component",
    looks_like=looks_like,
    read=read,
    public=11,
    public_check="number of samples, and largest and smallest value of 33 components in the files",
)
