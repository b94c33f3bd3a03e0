"""CSMIP volume 1, also as CDMG, USC and RENADIC wrote it: uncorrected acceleration of one or more channels.

Below text, 100 integers and 50 reals stand either values of a uniform step (`13200 Accelerogram points at 200 pts/sec in units
of g. Format: (8f9.6)`) or pairs of time and acceleration read from film, five pairs a line, in g/10.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count, duration, peak, peak_time
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.csmip_header import Header, header, sections
from rths_engine.formats.strong_motion.orientation import named_once
from rths_engine.formats.strong_motion.pairs import uniform_step
from rths_engine.formats.strong_motion.units_written import unit_named
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_FIRST = re.compile(r"^\s*(?:FILE\s+\d+ OF )?uncorrected accelerogram data", re.IGNORECASE)
_OPENS = re.compile(
    rf"^\s*(\d+)\s+(?:accelerogram points|points of acc\w* data,?)\s+"
    rf"(?:at\s+({NUMBER})\s*(?:pts|samples)/sec|equally[- ]spaced at\s*({NUMBER})\s*sec)(.*)$",
    re.IGNORECASE,
)
# lines, columns and places in the header, by definition of the format
_TEXT_LINES, _VALUE_LINES, _REAL_LINES = 13, 14, 7  # of a channel; 7 lines of integers and 7 of reals
_VALUES = fortran.Columns(8, 9)
_PAIRS = (fortran.Columns(10, 7), fortran.Columns(10, 7, 1))  # CSMIP; USC with a blank in front
_COUNT, _LENGTH, _PEAK, _PEAK_TIME = 28, 3, 7, 8  # integer header; real headers (s, g, s)
_UNITS = re.compile(r"\bunits\b.*?\b(?:are|is)\s+(?:sec and\s+)?(g/10|g)(?:\s*\.|\s*$|\s{2})", re.IGNORECASE)
_BLOCK_UNIT = re.compile(r"units?\s*(?:of|:)\s*(\S+)", re.IGNORECASE)
_IN_G = {"g": 1.0, "g/10": 0.1}  # by definition


def looks_like(source: Source) -> bool:
    """Whether the file is a CSMIP file of volume 1."""
    return any(_FIRST.match(line) for line in source.head_lines[:1])


def read(source: Source) -> Table:
    """Every channel as a column of acceleration. Raises FileError with the line of what does not follow the format."""
    columns: list[Column] = []
    statements: list[Statement] = []
    first: Header | None = None
    for lines in sections(source.lines):
        if not _FIRST.match(lines[0][1]):
            problem = "is not the first line of a channel"
            raise FileError(Issue(f"line {lines[0][0]}", problem, lines[0][1].strip(), "correct or remove it"))
        opens = next((at for at, (_, line) in enumerate(lines) if _OPENS.match(line)), None)
        about = header(lines[: _TEXT_LINES + _VALUE_LINES if opens is None else opens], _REAL_LINES)
        first = first or about
        about.check_azimuth()
        column, said = _paired(about, lines) if opens is None else _spaced(about, lines[opens], lines[opens + 1 :])
        columns.append(column)
        statements += said
    if first is None:
        raise FileError(Issue("file", "contains no channel", fix="get the file again"))
    return Table("CSMIP V1", named_once(columns), statements=tuple(statements), header=first.shown, about=first.about)


def _spaced(about: Header, opening: fortran.Line, rows: list[fortran.Line]) -> tuple[Column, list[Statement]]:
    """A channel with values of a uniform step."""
    at, line = opening
    found = _OPENS.match(line)
    assert found
    where, stated = f"line {at}", int(found[1])
    data = fortran.series(rows, fortran.Columns.written(line) or _VALUES)
    own = _BLOCK_UNIT.search(found[4])
    named, text = unit_named(own[1]) if own else "", _text_unit(about)
    if named and text and named != text:
        raise FileError(Issue(where, f"states {named}; the text states {text}", fix="correct the unit that is wrong"))
    if not 0 < fortran.number(found[2] or found[3]) < math.inf:
        raise FileError(Issue(where, "states a sampling rate or step that is not positive", line.strip(), "correct the header"))
    dt = 1 / fortran.number(found[2]) if found[2] else fortran.number(found[3])
    statements = [count(stated, len(data.values), where, about.name)]
    return _column(about, data.values, named or text, dt), statements + _compared(about, data, named or text, dt)


def _paired(about: Header, lines: list[fortran.Line]) -> tuple[Column, list[Statement]]:
    """A channel with pairs of time and acceleration."""
    rows = lines[len(about.text) + _VALUE_LINES :]
    if not about.integers or not rows:
        fix = "a channel has 13 lines of text, 7 of integers, 7 of reals, then data"
        raise FileError(Issue(f"line {lines[0][0]}", "starts a channel without header values or data", fix=fix))
    # the first field of USC's lines ends in column 8
    layout = _PAIRS[0] if rows[0][1][6:7].strip() and not rows[0][1][7:8].strip() else _PAIRS[1]
    data = fortran.series(rows, layout)
    if len(data.values) % 2:
        raise FileError(Issue(f"line {rows[-1][0]}", "ends in a time without acceleration", fix="get the file again"))
    times, values = data.values[::2], data.values[1::2]
    statements = [count(int(stated.value), len(times), stated.where, about.name) for stated in _counts(about)]
    if any(not one.agrees for one in statements):
        return _column(about, values, _text_unit(about), None), statements
    dt = uniform_step(times, fortran.series(rows[:1], layout).rounding or 0.0005, f"line {rows[0][0]}")
    unit = _text_unit(about)
    return _column(about, values, unit, dt), statements + _compared(about, fortran.Series(values, data.rounding), unit, dt)


def _column(about: Header, values: Array, unit: str, dt: float | None) -> Column:
    return Column(about.name, values, unit, dt, quantity="acceleration")


def _text_unit(about: Header) -> str:
    return next((unit_named(found[1]) for _, line in about.text if (found := _UNITS.search(line))), "")


def _counts(about: Header) -> Iterator[Written]:
    for where, found in about.find(r"No\. of points\s*=\s*(\d+)"):
        yield Written.of(found[1], where)
    if (coded := about.integer(_COUNT)) is not None:
        yield coded


def _compared(about: Header, data: fortran.Series, unit: str, dt: float) -> list[Statement]:
    """What text, integers and reals state about the data; peaks are stated in g."""
    name, samples = about.name, len(data.values)
    if not samples:
        return []
    found = [count(int(stated.value), samples, stated.where, name) for stated in _counts(about)]
    lengths = [Written.of(one[1], where) for where, one in about.find(rf"(?:record length|duration)\s*=\s*({NUMBER})\s*sec")]
    length = about.real(_LENGTH)
    found += [duration(one, samples, dt, name) for one in [*lengths, *([length] if length else [])]]
    for where, one in about.find(rf"\bat\s+({NUMBER})\s*samples/sec"):
        found.append(Statement("sampling rate", where, fortran.number(one[1]), 1 / dt, "Hz", 1e-3 / dt))
    if not (factor := _IN_G.get(unit)):
        return found
    in_g, rounding, later = data.values * factor, data.rounding * factor, _later(about)
    stated = [
        (fortran.stated(one[1], where), Written.of(one[2], where))
        for where, one in about.find(rf"\bMax\s*=\s*({NUMBER})\s*g\s*,\s*at\s+({NUMBER})\s*sec")
    ]
    largest, time = about.real(_PEAK), about.real(_PEAK_TIME)
    if stated and largest is not None and time is not None:
        stated.append((largest, time))
    for highest, at in stated:
        found.append(peak(highest, in_g, "g", rounding, name, signed=True))
        if later is not None:
            found.append(peak_time(Written(at.value + later, at.within, at.where), in_g, dt, of=name))
    return found


def _later(about: Header) -> float | None:
    """Seconds to add to a stated time of the peak: RENADIC counts it from the origin before the trigger; None if unknown."""
    if not any(about.find("RENADIC")):
        return 0.0
    clock = r"{}[^)]*?(\d+):(\d+):([\d.]+)"
    times = [next((one for _, one in about.find(clock.format(word))), None) for word in ("ORIGIN:", "TRIGGER TIME:")]
    if times[0] is None or times[1] is None:
        return None
    origin, trigger = (
        np.dot([3600, 60, 1], [fortran.number(part) for part in one.groups()]) for one in times if one is not None
    )
    return float((trigger - origin) % 86400)


FORMAT = Format(
    key="csmip_raw",
    title="CSMIP V1",
    of="ground motion",
    extensions=("v1", "raw"),
    defined="CSMIP standard format, OSMS 85-03; CDMG, USC and RENADIC volume 1",
    header="step, unit (g, g/10), station, channel, azimuth, event",
    compared="number of samples, step, duration, peak and its time, unit, azimuth; times of pairs are uniform",
    looks_like=looks_like,
    read=read,
    public=16,
    public_check="counts, steps, peaks and their times in the files; an independent parse by fixed columns",
)
