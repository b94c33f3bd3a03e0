"""COSMOS V2 and CSMIP V2: for each channel a text header, then blocks of acceleration, velocity and displacement.

The acceleration block opens with `4096 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)` (CSMIP) or with
`4096 acceleration pts, approx 41 secs, units=cm/sec2(04),Format=(8f10.5)` (COSMOS, step in the real-value header, number 34).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions.parsed import Parsed
from rths_engine.parts.ground_motions.text import NUMBER, block
from rths_engine.parts.ground_motions.units_in_text import unit_in

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


def looks_like(lines: list[str]) -> bool:
    """Whether the lines are a COSMOS or CSMIP V2 file."""
    return any(_CSMIP.match(line) or _COSMOS.match(line) for line in lines)


def parse(lines: list[str], channel: int = 1) -> Parsed:
    """The acceleration in block number `channel`. Raises MotionError with a list of the channels when there are fewer."""
    blocks = _blocks(lines)
    if not blocks:
        fix = "a V2 file has '... points of accel data equally spaced at ...' or '... acceleration pts, ...'"
        raise MotionError(Issue("file", "has no acceleration block", lines[0].strip(), fix))
    names = tuple(_name(found) for found in blocks)
    if not 1 <= channel <= len(blocks):
        listed = "; ".join(f"{number}: {name}" for number, name in enumerate(names, start=1))
        raise MotionError(Issue("channel", f"the file has {len(blocks)} channels", channel, f"choose one of {listed}"))
    chosen = blocks[channel - 1]
    opening = lines[chosen.at - 1]
    if re.search(r"\buncorrected\b", chosen.header[0], re.IGNORECASE) or "counts" in opening:
        raise MotionError(Issue("line 1", "is an uncorrected record", fix="give the corrected record (volume 2, .V2)"))
    event, station = _origin(chosen.header)
    return Parsed(
        samples=_samples(lines, chosen),
        format="cosmos",
        unit=unit_in(opening),
        dt=chosen.dt,
        title=", ".join(part for part in (event, station, names[channel - 1]) if part),
        event=event,
        station=station,
        component=names[channel - 1],
        channels=names,
        channel=channel,
    )


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
    samples = np.array(block(enumerate(lines[chosen.at : last], start=chosen.at + 1), int(fixed[2]) if fixed else 0))
    if len(samples) != chosen.count:
        problem = f"says {chosen.count} samples, but {len(samples)} follow"
        raise MotionError(Issue(f"line {chosen.at}", problem, fix="download the record again"))
    return samples


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
