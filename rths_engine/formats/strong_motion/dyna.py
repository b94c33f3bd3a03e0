"""DYNA text of ESM and ITACA (Europe), also of AFAD (Turkey): lines `KEY: value`, then one value a line."""

from __future__ import annotations

import re

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count, duration, peak, peak_time
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.strong_motion.units_written import unit_named
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import FileError, Issue

_KEY = re.compile(r"^[A-Z][A-Z0-9_/^ \-]*:")
_VALUES = fortran.Columns(1, 12)  # by definition of the format
# quantity -> its unit, and the keys of its peak and of the time of its peak
_QUANTITIES = {
    "acceleration": ("cm/s^2", r"PGA_CM/S\^2", "TIME_PGA_S"),
    "velocity": ("cm/s", "PGV_CM/S", "TIME_PGV_S"),
    "displacement": ("cm", "PGD_CM", "TIME_PGD_S"),
}
_FORMS = ("%Y%m%d_%H%M%S.%f", "%Y%m%d_%H%M%S", "%d/%m/%Y %H:%M:%S.%f", "%d/%m/%Y %H:%M:%S")


def looks_like(source: Source) -> bool:
    """Whether the file is DYNA text."""
    first = source.head_lines[:FIRST_LINES]
    return all(any(line.startswith(key) for line in first) for key in ("SAMPLING_INTERVAL_S:", "NDATA:", "DATA_TYPE:"))


def read(source: Source) -> Table:
    """The record in the file. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    end = next((at for at, line in lines if line.strip() and not _KEY.match(line)), len(lines) + 1) - 1
    header, rows = Keyed(lines[:end]), lines[end:]
    where, kind = next(header.find(r"^DATA_TYPE:\s*(.*)$"), ("header", None))
    stated_kind = kind[1].strip() if kind else ""
    quantity = next((one for one in _QUANTITIES if re.search(rf"\b{one}$", stated_kind, re.IGNORECASE)), "")
    if not quantity:
        problem = "is not a record of acceleration, velocity or displacement"
        raise FileError(Issue(where, problem, stated_kind, "give the time series of acceleration"))
    unit, peak_key, time_key = _QUANTITIES[quantity]
    stated_unit = next(header.find(r"^UNITS:\s*(.*)$"), None)
    if stated_unit is not None and stated_unit[1][1].strip() and unit_named(stated_unit[1][1]) != unit:
        problem = f"states a unit that is not {unit}, the unit of {quantity} in this format"
        raise FileError(Issue(stated_unit[0], problem, stated_unit[1][1].strip(), "correct the unit or the data type"))
    dt = header.needed(r"^SAMPLING_INTERVAL_S:\s*(\S+)", "sampling interval").value
    data = fortran.series(rows, _VALUES, MISSING)
    stated = header.needed(r"^NDATA:\s*(\S+)", "number of samples")
    statements = [count(int(stated.value), len(data.values), stated.where)]
    if len(data.values):
        statements += _compared(header, data, quantity, unit, dt, (peak_key, time_key))
    station, stream = header.text(r"^STATION_CODE:\s*(.*)$"), header.text(r"^(?:STREAM|COMPONENT):\s*(.*)$")
    event = header.text(r"^EVENT_NAME:\s*(.*)$") or header.text(r"^EVENT_ID:\s*(.*)$")
    place = header.text(r"^STATION_NAME:\s*(.*)$") or station
    about = {
        "title": ", ".join(part for part in (event, place) if part),
        "event": event,
        "station": place,
        "start": stamp(instant(header.text(r"^DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS:\s*(.*)$"), *_FORMS)),
    }
    column = Column(f"{station} {stream}".strip() or quantity, data.values, unit, dt, quantity=quantity)
    return Table("DYNA", (column,), statements=tuple(statements), header=header.shown, about=about)


def _compared(
    header: Keyed, data: fortran.Series, quantity: str, unit: str, dt: float, keys: tuple[str, str]
) -> list[Statement]:
    """Duration, peak and its time. AFAD states no time and a peak without sign."""
    found = []
    if (lasts := header.number(r"^DURATION_S:\s*(\S*)")) is not None:
        found.append(duration(lasts, len(data.values), dt))
    highest, time = (header.number(rf"^{key}:\s*(\S*)") for key in keys)
    if highest is not None:
        found.append(peak(highest, data.values, unit, data.rounding, signed=time is not None or highest.value < 0))
    if time is not None:
        found.append(peak_time(time, data.values, dt))
    return found


FORMAT = Format(
    key="dyna",
    title="DYNA (ESM, ITACA, AFAD)",
    of="ground motion",
    extensions=("asc", "dat"),
    defined="ESM and ITACA, DYNA 1.2 ASCII",
    header="quantity, unit, step, component, station, event, start (UTC)",
    compared="number of samples, duration, unit, peak and its time",
    looks_like=looks_like,
    read=read,
    public=7,
    public_check="number of samples, unit, peak and its time in the files; the file of AFAD states no time",
)
