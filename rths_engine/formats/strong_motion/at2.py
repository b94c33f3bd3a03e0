"""PEER NGA AT2: header lines ending in `NPTS= 5372, DT= .0100 SEC` or `5372  .0100  NPTS, DT`, then samples in g."""

from __future__ import annotations

import re

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER, block
from rths_engine.formats.source import Source
from rths_engine.formats.statement import count as stated_count
from rths_engine.formats.table import Column, Table
from rths_engine.formats.units_in_text import unit_in
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_HEADER_LINES = 12
_NAMED = re.compile(rf"NPTS\s*=\s*(\d+)\s*,?\s*DT\s*=\s*({NUMBER}|[A-Z]+)", re.IGNORECASE)
_LISTED = re.compile(rf"^\s*(\d+)\s+({NUMBER})\s+NPTS\s*,\s*DT", re.IGNORECASE)


def looks_like(source: Source) -> bool:
    """Whether the file is a PEER AT2 file: its header contains NPTS and DT, or its name promises it."""
    first = source.head_lines[:_HEADER_LINES]
    stated = any("NPTS" in line.upper() and "DT" in line.upper() for line in first)
    return stated or (source.extension == "at2" and bool(first) and not re.match(rf"\s*{NUMBER}[\s,;]*$|.*\t", first[-1]))


def read(source: Source) -> Table:
    """The record in an AT2 file. Raises FileError with the line where header or samples do not follow the format."""
    lines = source.lines
    at, count, dt = _counts(lines)
    header = lines[: at - 1]
    about = " ".join(header).upper()
    if re.search(r"\b(VELOCITY|DISPLACEMENT) TIME", about):
        raise FileError(
            Issue("file", "contains velocity or displacement, not acceleration", fix="give the record's acceleration (.AT2)")
        )
    samples = np.array(block(enumerate(lines[at:], start=at + 1)))
    described = header[1].strip() if len(header) > 1 else ""
    event, station, component = _described(described)
    column = Column(component or "acceleration", samples, unit_in(about) or "g", dt, quantity="acceleration")
    return Table(
        "PEER AT2",
        (column,),
        statements=(stated_count(count, len(samples), f"line {at}"),),
        header="\n".join(lines[:at]),
        about={"title": described, "event": event, "station": station},
    )


def _counts(lines: list[str]) -> tuple[int, int, float]:
    """Line number of the NPTS line, NPTS and DT (s)."""
    for at, line in enumerate(lines[:_HEADER_LINES], start=1):
        found = _NAMED.search(line) or _LISTED.search(line)
        if found:
            try:
                return at, int(found[1]), float(found[2])
            except ValueError:
                raise FileError(
                    Issue(f"line {at}", "needs a uniform step DT in seconds", found[2], "give a record with a uniform step")
                ) from None
        if "NPTS" in line.upper():
            fix = "write it as 'NPTS= 4000, DT= .0100 SEC'"
            raise FileError(Issue(f"line {at}", "does not state NPTS and DT in a known format", line.strip(), fix))
    first = lines[0].strip()
    fix = "an AT2 file has 'NPTS= 4000, DT= .0100 SEC' in line 4; for plain columns choose the format, the unit and the step"
    raise FileError(Issue("line 1", "the header has no NPTS and DT, so this is not an AT2 record", first, fix))


def _described(line: str) -> tuple[str, str, str]:
    """Event, station and component from `Northridge-01, 1/17/1994, Canyon Country - W Lost Cany, 0`."""
    parts = [part.strip() for part in line.split(",")]
    return (", ".join(parts[:-2]), parts[-2], parts[-1]) if len(parts) >= 3 else (line, "", "")


FORMAT = Format(
    key="at2",
    title="PEER AT2",
    of="ground motion",
    extensions=("at2",),
    defined="PEER NGA strong motion database",
    header="number of samples, step, unit, event, station, component",
    compared="number of samples",
    looks_like=looks_like,
    read=read,
)
