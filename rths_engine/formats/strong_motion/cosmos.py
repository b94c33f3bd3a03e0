"""COSMOS V2 and CSMIP V2: for each channel a text header, then blocks of acceleration, velocity and displacement.

The acceleration block opens with `4096 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)` (CSMIP) or with
`4096 acceleration pts, approx 41 secs, units=cm/sec2(04),Format=(8f10.5)` (COSMOS, step in the real-value header, number 34).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER, block
from rths_engine.formats.source import Source
from rths_engine.formats.statement import count as stated_count
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.formats.units_in_text import unit_in
from rths_engine.foundation.errors import FileError, Issue

_CSMIP = re.compile(rf"^\s*(\d+)\s+points of accel\w* data,? equally spaced at\s*({NUMBER})\s*sec", re.IGNORECASE)
_COSMOS = re.compile(r"^\s*(\d+)\s+acceleration\s+pts", re.IGNORECASE)
_OPENS = re.compile(
    r"^\s*\d+\s+(?:points of (?:accel|veloc|displ)|(?:acceleration|velocity|displacement)\s+pts)", re.IGNORECASE
)
_REALS = re.compile(r"^\s*(\d+)\s+real-header values", re.IGNORECASE)
_FORMAT = re.compile(r"\(\s*(\d+)\s*[fe]\s*(\d+)\.\d+[^)]*\)", re.IGNORECASE)
_CHANNEL = re.compile(r"\bCha?n(?:nel)?\.?\s*(\d+)\s*:\s*(.*?)(?:\s{2,}|\(|$)", re.IGNORECASE)
_END = re.compile(r"End[- ]of[- ]data", re.IGNORECASE)
_STEP_NUMBER = 34  # of the real-value header of COSMOS V2: the step, s


@dataclass(frozen=True, slots=True)
class _Block:
    """One acceleration block: its first line (from 1), its number of samples, and the header before it."""

    at: int
    count: int
    dt: float | None
    header: list[str]


def looks_like(source: Source) -> bool:
    """Whether the file is a COSMOS or CSMIP V2 file."""
    return any(_CSMIP.match(line) or _COSMOS.match(line) for line in source.head_lines)


def read(source: Source) -> Table:
    """Every acceleration block as a column. Raises FileError with the line of what does not follow the format."""
    lines = source.lines
    blocks = _blocks(lines)
    if not blocks:
        fix = "a V2 file has '... points of accel data equally spaced at ...' or '... acceleration pts, ...'"
        raise FileError(Issue("file", "has no acceleration block", lines[0].strip(), fix))
    names = tuple(_name(found) for found in blocks)
    columns, statements = [], []
    for name, found in zip(names, blocks, strict=True):
        opening = lines[found.at - 1]
        if re.search(r"\buncorrected\b", found.header[0], re.IGNORECASE) or "counts" in opening:
            fix = "give the corrected record (volume 2, .V2)"
            raise FileError(Issue(f"line {found.at - len(found.header)}", "is an uncorrected record", fix=fix))
        samples = _samples(lines, found)
        statements.append(stated_count(found.count, len(samples), f"line {found.at}", name))
        columns.append(Column(name, samples, unit_in(opening) or "", found.dt, quantity="acceleration"))
    event, station = _origin(blocks[0].header)
    about = {"title": ", ".join(part for part in (event, station) if part), "event": event, "station": station}
    header = "\n".join(lines[: blocks[0].at])
    return Table("COSMOS or CSMIP V2", distinct(columns), statements=tuple(statements), header=header, about=about)


def _blocks(lines: list[str]) -> list[_Block]:
    blocks, start = [], 0
    for at, line in enumerate(lines, start=1):
        csmip, cosmos = _CSMIP.match(line), _COSMOS.match(line)
        if csmip:
            blocks.append(_Block(at, int(csmip[1]), float(csmip[2]), lines[start : at - 1] or [""]))
        elif cosmos:
            header = lines[start : at - 1] or [""]
            blocks.append(_Block(at, int(cosmos[1]), _step(header, start), header))
        elif _END.search(line):
            start = at
    return blocks


def _step(header: list[str], offset: int) -> float | None:
    """Step (s): real-value header number 34."""
    for index, line in enumerate(header):
        found = _REALS.match(line)
        if found:
            fixed = _FORMAT.search(line)
            per_line = int(fixed[1]) if fixed else 5
            rows = -(-_STEP_NUMBER // per_line)
            first = offset + index + 2
            values = block(enumerate(header[index + 1 : index + 1 + rows], start=first), int(fixed[2]) if fixed else 0)
            return values[_STEP_NUMBER - 1] if len(values) >= _STEP_NUMBER and values[_STEP_NUMBER - 1] > 0 else None
    return None


def _samples(lines: list[str], chosen: _Block) -> np.ndarray:
    fixed = _FORMAT.search(lines[chosen.at - 1])
    last = chosen.at
    while last < len(lines) and not (_OPENS.match(lines[last]) or _END.search(lines[last])):
        last += 1
    return np.array(block(enumerate(lines[chosen.at : last], start=chosen.at + 1), int(fixed[2]) if fixed else 0))


def _name(found: _Block) -> str:
    for line in found.header:
        match = _CHANNEL.search(line)
        if match:
            return match[2].strip() or f"channel {match[1]}"
    return "acceleration"


def _origin(header: list[str]) -> tuple[str, str]:
    """Event and station, from the header lines that both formats use for them."""
    station = next((line.split(":")[-1] for line in header if re.search(r"CA\s*:", line)), "")
    event = next((line for line in header if re.search(r"\bearthquake\b", line, re.IGNORECASE)), "")
    return " ".join(event.split())[:80], " ".join(station.split())[:80]


FORMAT = Format(
    key="cosmos",
    title="COSMOS V2 and CSMIP V2",
    of="ground motion",
    extensions=("v2", "v2c"),
    defined="COSMOS Strong Motion Data Format 1.20; CSMIP standard tape format",
    header="step, unit, number of samples, channel names, event, station",
    compared="number of samples of each channel",
    looks_like=looks_like,
    read=read,
)
