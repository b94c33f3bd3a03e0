"""PEER NGA AT2: header lines ending in `NPTS= 5372, DT= .0100 SEC` or `5372  .0100  NPTS, DT`, then samples in g."""

from __future__ import annotations

import re

import numpy as np

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions.parsed import Parsed
from rths_engine.parts.ground_motions.text import NUMBER, block
from rths_engine.parts.ground_motions.units_in_text import unit_in

# chosen; see docs/decisions/0023
_HEADER_LINES = 12
_NAMED = re.compile(rf"NPTS\s*=\s*(\d+)\s*,?\s*DT\s*=\s*({NUMBER}|[A-Z]+)", re.IGNORECASE)
_LISTED = re.compile(rf"^\s*(\d+)\s+({NUMBER})\s+NPTS\s*,\s*DT", re.IGNORECASE)


def looks_like(lines: list[str]) -> bool:
    """Whether the lines are a PEER AT2 file: its header contains NPTS and DT."""
    return any("NPTS" in line.upper() and "DT" in line.upper() for line in lines[:_HEADER_LINES])


def parse(lines: list[str]) -> Parsed:
    """The record in an AT2 file. Raises MotionError with the line where header or samples do not follow the format."""
    at, count, dt = _counts(lines)
    header = lines[: at - 1]
    about = " ".join(header).upper()
    if re.search(r"\b(VELOCITY|DISPLACEMENT) TIME", about):
        raise MotionError(
            Issue("file", "contains velocity or displacement, not acceleration", fix="give the record's acceleration (.AT2)")
        )
    samples = np.array(block(enumerate(lines[at:], start=at + 1)))
    if len(samples) != count:
        problem = f"says NPTS = {count}, but {len(samples)} samples follow"
        raise MotionError(Issue(f"line {at}", problem, fix="download the record again or correct NPTS"))
    described = header[1].strip() if len(header) > 1 else ""
    event, station, component = _described(described)
    return Parsed(samples, "at2", unit_in(about) or "g", dt, described, event, station, component)


def _counts(lines: list[str]) -> tuple[int, int, float]:
    """Line number of the NPTS line, NPTS and DT (s)."""
    for at, line in enumerate(lines[:_HEADER_LINES], start=1):
        found = _NAMED.search(line) or _LISTED.search(line)
        if found:
            try:
                return at, int(found[1]), float(found[2])
            except ValueError:
                raise MotionError(
                    Issue(f"line {at}", "needs a uniform step DT in seconds", found[2], "give a record with a uniform step")
                ) from None
        if "NPTS" in line.upper():
            fix = "write it as 'NPTS= 4000, DT= .0100 SEC'"
            raise MotionError(Issue(f"line {at}", "does not state NPTS and DT in a known format", line.strip(), fix))
    first = lines[0].strip()
    fix = "an AT2 file has 'NPTS= 4000, DT= .0100 SEC' in line 4; for plain columns choose the format, the unit and the step"
    raise MotionError(Issue("line 1", "the header has no NPTS and DT, so this is not an AT2 record", first, fix))


def _described(line: str) -> tuple[str, str, str]:
    """Event, station and component from `Northridge-01, 1/17/1994, Canyon Country - W Lost Cany, 0`."""
    parts = [part.strip() for part in line.split(",")]
    return (", ".join(parts[:-2]), parts[-2], parts[-1]) if len(parts) >= 3 else (line, "", "")
