"""PEER AT2 and COSMOS V2 files as measurements: every acceleration channel with the step of the file."""

from __future__ import annotations

from rths_engine.parts.ground_motions import at2, cosmos
from rths_engine.parts.ground_motions.parsed import Parsed
from rths_engine.recordings.measured.table import Column, Table


def looks_like(lines: list[str]) -> bool:
    """Whether the lines are a ground-motion file of COSMOS or PEER."""
    return cosmos.looks_like(lines) or at2.looks_like(lines)


def read(lines: list[str]) -> Table:
    """Raises MotionError."""
    if not cosmos.looks_like(lines):
        return Table("PEER AT2", (_column(at2.parse(lines), "acceleration"),))
    first = cosmos.parse(lines)
    parsed = [first, *(cosmos.parse(lines, channel) for channel in range(2, len(first.channels) + 1))]
    columns = [
        _column(one, f"acceleration {k}: {name}") for k, (one, name) in enumerate(zip(parsed, first.channels, strict=True), 1)
    ]
    return Table("COSMOS V2", tuple(columns))


def _column(parsed: Parsed, name: str) -> Column:
    return Column(name, parsed.samples, parsed.unit or "", parsed.dt)
