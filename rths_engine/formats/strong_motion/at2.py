"""PEER AT2, VT2 and DT2: header lines ending in `NPTS= 5372, DT= .0100 SEC` or `5372  .0100  NPTS, DT`, then samples.

The header says which quantity the samples are, and their unit: acceleration in g, velocity in cm/s or displacement in cm. The
columns are not stated; numbers that touch are read only where each has an exponent and a sign (`-1.2E-01-3.4E-02`).
"""

from __future__ import annotations

import re

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER, TOUCHING, value
from rths_engine.formats.source import Source
from rths_engine.formats.statement import count as stated_count
from rths_engine.formats.strong_motion.units_written import unit_named
from rths_engine.formats.table import Column, Table
from rths_engine.formats.units_in_text import unit_in
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_HEADER_LINES = 12
_MISSING = -999.0  # as networks mark it
_SERIES = re.compile(
    r"\b(ACCELERATION|VELOCITY|DISPLACEMENT) TIME[ -](?:SERIES|HISTORY)(?:.*?\bUNITS?\s*(?:OF|:|=|IN)?\s*([A-Z/\d^*.]+))?",
    re.IGNORECASE,
)
_EXPONENTIAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)[eEdD][-+]?\d+")
_EXPONENTIALS = re.compile(rf"{_EXPONENTIAL.pattern}(?:[-+]{_EXPONENTIAL.pattern.removeprefix('[-+]?')})+")
_NAMED = re.compile(rf"NPTS\s*=\s*(\d+)\s*,?\s*DT\s*=\s*({NUMBER}|[A-Z]+)", re.IGNORECASE)
_LISTED = re.compile(rf"^\s*(\d+)\s+({NUMBER})\s+NPTS\s*,\s*DT", re.IGNORECASE)


def looks_like(source: Source) -> bool:
    """Whether the file is a PEER file: its header contains NPTS and DT, or its name promises it and its first line is text."""
    first = source.head_lines[:_HEADER_LINES]
    own = [line.upper() for line in first if not line.lstrip().startswith(("#", "%", "!"))]  # a comment is no header of PEER
    called = source.extension in FORMAT.extensions or any(_SERIES.search(line) for line in own)
    stated = any(_NAMED.search(line) or _LISTED.search(line) or (called and "NPTS" in line and "DT" in line) for line in own)
    columns = not first or "\t" in first[-1] or any(value(token) is not None for token in re.split(r"[\s,;]+", first[-1]))
    return stated or (source.extension in FORMAT.extensions and not columns)


def read(source: Source) -> Table:
    """The record in an AT2 file. Raises FileError with the line where header or samples do not follow the format."""
    lines = source.lines
    at, count, dt = _counts(lines)
    header = lines[: at - 1]
    quantity, unit = _quantity(header)
    samples, rest = _samples(lines, at, count)
    described = header[1].strip() if len(header) > 1 else ""
    peer = "STRONG MOTION" in header[0].upper() or "STRONG-MOTION" in header[0].upper() if header else False
    event, station, component = _described(described) if peer else (described, "", "")
    column = Column(component or quantity, samples, unit, dt, quantity=quantity)
    return Table(
        "PEER AT2",
        (column,),
        notes=rest,
        statements=(stated_count(count, len(samples), f"line {at}"),),
        header="\n".join(lines[:at]),
        about={"title": described, "event": event, "station": station},
    )


def _counts(lines: list[str]) -> tuple[int, int, float]:
    """Line number of the NPTS line, NPTS and DT (s): of the last such line, where a header contains an older header."""
    counts: tuple[int, int, float] | None = None
    for at, line in enumerate(lines[:_HEADER_LINES], start=1):
        found = _NAMED.search(line) or _LISTED.search(line)
        if found:
            try:
                counts = at, int(found[1]), float(found[2])
            except ValueError:
                raise FileError(
                    Issue(f"line {at}", "needs a uniform step DT in seconds", found[2], "give a record with a uniform step")
                ) from None
        elif "NPTS" in line.upper():
            fix = "write it as 'NPTS= 4000, DT= .0100 SEC'"
            raise FileError(Issue(f"line {at}", "does not state NPTS and DT in a known format", line.strip(), fix))
        elif counts is not None and line.strip() and not _is_text(line):
            break
    if counts is not None:
        return counts
    first = lines[0].strip()
    fix = "an AT2 file has 'NPTS= 4000, DT= .0100 SEC' in line 4; for plain columns choose the format, the unit and the step"
    raise FileError(Issue("line 1", "the header has no NPTS and DT, so this is not an AT2 record", first, fix))


def _quantity(header: list[str]) -> tuple[str, str]:
    """Quantity and unit by the line `VELOCITY TIME SERIES IN UNITS OF CM/S`; the unit is empty where no line states it."""
    for line in header:
        if found := _SERIES.search(line):
            return found[1].lower(), unit_named(found[2] or "") or (unit_in(line) or "")
    return "acceleration", unit_in(" ".join(header)) or ""


def _samples(lines: list[str], start: int, count: int) -> tuple[Array, tuple[str, ...]]:
    """The samples below line `start`, and a note on text below the last of the stated samples. Raises FileError."""
    found: list[float] = []
    for at, line in enumerate(lines[start:], start=start + 1):
        if len(found) == count and _is_text(line) and all(_is_text(one) for one in lines[at:]):
            note = f"text from line {at}, below the last of {count} samples, was not read: {line.strip()}"
            return np.array(found), (note,)
        found += _numbers(line, f"line {at}")
    return np.array(found), ()


def _is_text(line: str) -> bool:
    """Whether a line is empty or contains letters and at least one word that is not a number."""
    tokens = line.split()
    return not tokens or (any(one.isalpha() for one in line) and not all(value(token) is not None for token in tokens))


def _numbers(line: str, where: str) -> list[float]:
    """The numbers of a line. Raises FileError for text, for missing samples, and for numbers that nothing separates."""
    found: list[float] = []
    for token in line.split():
        number = value(token)
        if number is not None:
            found.append(number)
        elif _EXPONENTIALS.fullmatch(token):
            found += [float(part.replace("D", "E").replace("d", "e")) for part in _EXPONENTIAL.findall(token)]
        elif TOUCHING.fullmatch(token):
            problem = "contains numbers that nothing separates"
            raise FileError(Issue(where, problem, token, "write blanks between the numbers"))
        else:
            raise FileError(Issue(where, "is not a number", token, "correct or remove it: only numbers can follow the header"))
    if _MISSING in found:
        problem = "contains the value that marks a missing sample"
        raise FileError(Issue(where, problem, f"{_MISSING:g}", "give a record without gaps"))
    return found


def _described(line: str) -> tuple[str, str, str]:
    """Event, station and component from `Northridge-01, 1/17/1994, Canyon Country - W Lost Cany, 0`."""
    parts = [part.strip() for part in line.split(",")]
    return (", ".join(parts[:-2]), parts[-2], parts[-1]) if len(parts) >= 3 else (line, "", "")


FORMAT = Format(
    key="at2",
    title="PEER AT2, VT2 and DT2",
    of="ground motion",
    extensions=("at2", "vt2", "dt2"),
    defined="PEER NGA strong motion database",
    header="quantity, number of samples, step, unit, event, station, component",
    compared="number of samples",
    looks_like=looks_like,
    read=read,
    public=292,
    public_check="number of samples in the files; an independent parse of 290 of them",
)
