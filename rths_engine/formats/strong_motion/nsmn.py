"""Text of the Turkish strong-motion network (AFAD, NSMN): labelled lines, a row of names, then a column for each component."""

from __future__ import annotations

import re

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Written, count, peak
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.strong_motion.units_written import gal_only
from rths_engine.formats.table import Column, Table
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.errors import FileError, Issue

_NAMES = re.compile(r"^\s*[NEUSWDZV](?:-[NEUSWD])?(?:\s+[NEUSWDZV](?:-[NEUSWD])?)+\s*$")
_PEAKS = re.compile(r"^RAW PGA VALUES\s*\(\s*(\S+?)\s*\)\s*:(.*)$", re.IGNORECASE)
_PEAK = re.compile(rf"\(\s*([^)]+?)\s*\)\s*({NUMBER})")
_INTERVAL = r"^SAMPLING INTERVAL\s*\(\s*([^)]*?)\s*\)"
_WIDTH = 13  # by definition of the format


def looks_like(source: Source) -> bool:
    """Whether the file is a record of the Turkish network."""
    first = source.head_lines[:FIRST_LINES]
    return any(re.match(r"NUMBER OF DATA\s*:", line) for line in first) and any(_PEAKS.match(line) for line in first)


def read(source: Source) -> Table:
    """Every component as a column. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    at = next((at for at, line in lines[:FIRST_LINES] if _NAMES.match(line)), None)
    if at is None:
        fix = "write the names of the components above the numbers: N-S E-W U-D"
        raise FileError(Issue("header", "has no row of names above the numbers", fix=fix))
    header, names = Keyed(lines[: at - 1]), lines[at - 1][1].split()
    unit, peaks = _peaks(header)
    step = _step(header)
    data = fortran.series(lines[at:], fortran.Columns(len(names), _WIDTH), MISSING)
    if len(data.values) % len(names):
        where = f"line {lines[-1][0]}"
        raise FileError(Issue(where, f"ends a row without all of {len(names)} components", fix="get the file again"))
    rows = data.values.reshape(-1, len(names))
    stated = header.needed(r"^NUMBER OF DATA\s*:\s*(\S*)", "number of samples")
    statements = [count(int(stated.value), len(rows), stated.where)]
    if missing := [name for name in peaks if name not in names]:
        problem = f"states peaks of {', '.join(peaks)}; the columns are {', '.join(names)}"
        raise FileError(Issue(peaks[missing[0]].where, problem, fix="correct the names of the columns"))
    station = header.text(r"^STATION ID\s*:\s*(\S*)")
    columns = []
    for number, name in enumerate(names):
        values = np.ascontiguousarray(rows[:, number])
        if name in peaks and len(values):
            statements.append(peak(peaks[name], values, unit, data.rounding, name))
        columns.append(Column(f"{station} {name}".strip(), values, unit, step, quantity="acceleration"))
    place = header.text(r"^PLACE\s*:\s*(\S.*)$") or station
    event = ", ".join(
        part
        for part in (header.text(r"^EARTHQUAKE DATE\s*:\s*(\S.*)$"), header.text(r"^EARTHQUAKE MAGNITUDE\s*:\s*(\S.*)$"))
        if part
    )
    recorded = header.text(r"^RECORD TIME\s*:\s*(.*?)\s*(?:\(GMT\))?\s*$")
    about = {
        "title": ", ".join(part for part in (event, place) if part),
        "event": event,
        "station": place,
        "start": stamp(instant(recorded, "%d/%m/%Y %H:%M:%S.%f", "%d/%m/%Y %H:%M:%S")),
    }
    return Table("AFAD (NSMN)", tuple(columns), statements=tuple(statements), header=header.shown, about=about)


def _step(header: Keyed) -> float:
    """The sampling interval (s), in the unit that its label states."""
    stated = header.needed(r"^SAMPLING INTERVAL\s*\([^)]*\)\s*:\s*(\S*)", "sampling interval")
    label = header.text(_INTERVAL)
    unit = unit_names.read(label)
    if unit.dimension != "time":
        raise FileError(Issue(stated.where, "states a unit of the sampling interval that is not known", label, "write (sec)"))
    return stated.value * unit.scale * units.factor(unit.unit)


def _peaks(header: Keyed) -> tuple[str, dict[str, Written]]:
    """The unit, which only the label of the peaks states, and the peak of each component."""
    for at, line in header.lines:
        if found := _PEAKS.match(line):
            unit = gal_only(found[1], f"line {at}")
            return unit, {one[1]: Written.of(one[2], f"line {at}") for one in _PEAK.finditer(found[2])}
    raise FileError(Issue("header", "does not state the peaks and their unit", fix="get the file again"))


FORMAT = Format(
    key="nsmn",
    title="AFAD (NSMN)",
    of="ground motion",
    extensions=("txt",),
    defined="AFAD, strong ground motion records of Turkiye",
    header="unit, step, components, station, event, start (UTC)",
    compared="number of samples, peak and name of each component",
    looks_like=looks_like,
    read=read,
    public=23,
    public_check="number of samples and the peak of 69 components in the files",
)
