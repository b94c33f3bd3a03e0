"""CSMIP volume 2, also as CDMG and USC wrote it: for each channel a header, then acceleration, velocity and displacement.

Each block opens with `4096 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, Written, count, duration, peak, peak_time, step
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.csmip_header import Header, header, sections
from rths_engine.formats.strong_motion.orientation import named_once
from rths_engine.formats.strong_motion.units_written import unit_named
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import FileError, Issue

_OPENS = re.compile(
    rf"^\s*(\d+)\s+points of (acc|vel|dis)\w*\.?\s+data,?\s+equally[- ]spaced at\s*({NUMBER})\s*sec(.*)$", re.IGNORECASE
)
_UNIT = re.compile(r"\bunits?\s*(?:of|:)?\s*([a-z/.\d]+)|\bin\s+([a-z/\d]+)", re.IGNORECASE)
_QUANTITIES = {"acc": "acceleration", "vel": "velocity", "dis": "displacement"}
# lines, columns and places in the header, by definition of the format
_REAL_LINES = 13  # 100 values, 8 a line
_STANDARD = fortran.Columns(8, 10)
# number of samples by integer header, time of the peak and peak by real header, of each quantity
_NUMBERS = {"acceleration": (53, 65, 66), "velocity": (53, 67, 68), "displacement": (53, 69, 70)}
_LENGTH, _STEP = 60, 61  # real headers, s


def looks_like(source: Source) -> bool:
    """Whether the file is a CSMIP file of volume 2."""
    corrected = any(re.match(r"\s*corrected accel", line, re.IGNORECASE) for line in source.head_lines[:1])
    opened = next((found for line in source.head_lines if (found := _OPENS.match(line))), None)
    raw = any(re.match(r"\s*(file.*)?uncorrected accel", line, re.IGNORECASE) for line in source.head_lines[:1])
    return opened is not None and (corrected or not raw)


def read(source: Source) -> Table:
    """Every block of every channel as a column. Raises FileError with the line of what does not follow the format."""
    columns: list[Column] = []
    statements: list[Statement] = []
    notes: list[str] = []
    first: Header | None = None
    for lines in sections(source.lines):
        starts = [at for at, (_, line) in enumerate(lines) if _OPENS.match(line)]
        if not starts:
            fix = "a channel has '... points of accel data equally spaced at ... sec'"
            raise FileError(Issue(f"line {lines[0][0]}", "starts a channel without data", lines[0][1].strip(), fix))
        about = header(lines[: starts[0]], _REAL_LINES)
        first = first or about
        about.check_azimuth()
        for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
            column, said = _block(about, lines[start], lines[start + 1 : end])
            columns.append(column)
            statements += said
            if _opposite(about, column):
                notes.append(f"{column.name} {column.quantity}: the header states the peak with the opposite sign")
    if first is None:
        raise FileError(Issue("file", "contains no channel", fix="get the file again"))
    return Table(
        "CSMIP V2", named_once(columns), statements=tuple(statements), notes=tuple(notes), header=first.shown, about=first.about
    )


def _block(about: Header, opening: fortran.Line, rows: list[fortran.Line]) -> tuple[Column, list[Statement]]:
    """The column of a block, and what text, integers and reals state about it."""
    at, line = opening
    found = _OPENS.match(line)
    assert found
    stated, quantity, rest = int(found[1]), _QUANTITIES[found[2].lower()], found[4]
    name = about.name
    data = fortran.series(rows, fortran.Columns.written(rest) or _STANDARD)
    label = f"{name} {quantity}".strip()
    statements = [count(stated, len(data.values), f"line {at}", label)]
    own = quantity != "acceleration" and _by_usc(about)  # whose velocity and displacement can have steps of their own
    written = None if own else about.real(_STEP)
    dt = written.value if written is not None and written.value > 0 else fortran.number(found[3])
    unit = _unit(about, rest, quantity, f"line {at}")
    column = Column(name, data.values, unit, dt, quantity=quantity)
    if stated and stated == len(data.values):
        if not own:
            statements += [*_steps(about, Written.of(found[3], f"line {at}"), dt), *_counts(about, quantity, stated, label)]
        statements += [duration(length, stated, dt, label) for length in _lengths(about)]
        statements += _peaks(about, column, data.rounding, label)
    return column, statements


def _unit(about: Header, rest: str, quantity: str, where: str) -> str:
    """The unit of a block by its first line and by the text. Raises FileError where they differ."""
    own = _UNIT.search(re.sub(r"\(\s*\d+[fe].*$", "", rest, flags=re.IGNORECASE))
    named = unit_named(own[1] or own[2]) if own else ""
    text = next((unit_named(found[2]) for _, found in _texts(about, quantity)), "")
    if named and text and named != text:
        problem = f"states {named}; the text states {text} for the peak"
        raise FileError(Issue(where, problem, fix="correct the unit that is wrong"))
    return named or text


def _texts(about: Header, quantity: str) -> Iterator[tuple[str, re.Match[str]]]:
    return about.find(rf"peak\s+{quantity}\s*=\s*({NUMBER})\s+(\S+)\s+at\s+({NUMBER})\s*sec")


def _steps(about: Header, own: Written, dt: float) -> Iterator[Statement]:
    yield step(own, dt)
    for where, found in about.find(rf"equally[- ]spaced intervals of\s+({NUMBER})\s*sec"):
        yield step(Written.of(found[1], where), dt)


def _counts(about: Header, quantity: str, samples: int, label: str) -> Iterator[Statement]:
    for where, found in about.find(r"^\s*(\d+)\s+(?:points of )?instrument\b"):
        yield count(int(found[1]), samples, where, label)
    if (coded := about.integer(_NUMBERS[quantity][0])) is not None:
        yield count(int(coded.value), samples, coded.where, label)


def _lengths(about: Header) -> Iterator[Written]:
    """Durations (s) of the corrected record."""
    if (length := about.real(_LENGTH)) is not None and length.value > 0:
        yield length
    for where, found in about.find(rf"record length\s*=\s*({NUMBER})\s*sec"):
        yield Written.of(found[1], where)


def _opposite(about: Header, column: Column) -> bool:
    """Whether the text states the peak of the column with the opposite sign, as USC does."""
    signs = {math.copysign(1, fortran.number(found[1])) for _, found in _texts(about, column.quantity)}
    return bool(len(column.values)) and signs == {-math.copysign(1, column.values[np.argmax(np.abs(column.values))])}


def _by_usc(about: Header) -> bool:
    return any(about.find(r"OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I"))


def _peaks(about: Header, column: Column, rounding: float, label: str) -> Iterator[Statement]:
    """Peak and its time in text and reals. USC's volume 2 states peaks with the sign of film, so that the sign is not held."""
    assert column.dt is not None
    _, time_at, peak_at = _NUMBERS[column.quantity]
    stated = [(fortran.stated(found[1], where), Written.of(found[3], where)) for where, found in _texts(about, column.quantity)]
    largest, time = about.real(peak_at), about.real(time_at)
    if largest is not None and time is not None and (largest.value or time.value):
        stated.append((largest, time))
    for one, at in stated:
        yield peak(one, column.values, column.unit, rounding, label, signed=not _by_usc(about))
        yield peak_time(at, column.values, column.dt, of=label)


FORMAT = Format(
    key="csmip",
    title="CSMIP V2",
    of="ground motion",
    extensions=("v2",),
    defined="CSMIP standard format, OSMS 85-03; CDMG and USC volume 2",
    header="step, unit, station, channel, azimuth, event",
    compared="number of samples, step, duration, peak and its time of each block, unit, azimuth",
    looks_like=looks_like,
    read=read,
    public=35,
    public_check="counts, steps, peaks and their times of every block in the files; an independent parse by fixed columns",
)
