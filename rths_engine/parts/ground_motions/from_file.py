"""A ground motion from a file of any format: one acceleration channel, in SI, with its origin."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path, PurePath

import numpy as np

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table
from rths_engine.foundation import units
from rths_engine.foundation.errors import FileError, Issue, MotionError
from rths_engine.parts.ground_motions.checks import checked, in_counts
from rths_engine.parts.ground_motions.record import Motion, slug

_PEAKS = ("peak", "maximum", "minimum")  # as statements call them
_ROUNDING = 1e-9  # of the peak, one number converted twice; chosen, see docs/decisions/0023
_LARGEST_FILE = 100_000_000  # bytes: ten channels of a million samples; chosen, see docs/decisions/0023


@dataclass(frozen=True, slots=True)
class Channel:
    """An acceleration channel of a file: its number from 1, by which it is chosen, and its name."""

    number: int
    column: Column

    @property
    def name(self) -> str:
        return self.column.name

    @property
    def asks(self) -> tuple[str, ...]:
        """What the file does not state and `read` asks for: `unit`, or the acceleration of one `count` as unit; `dt`."""
        unit, counts = not self.column.unit, in_counts(self.column)
        return tuple(name for name, lacks in (("unit", unit), ("count", counts), ("dt", self.column.dt is None)) if lacks)


@dataclass(frozen=True, slots=True)
class Contents:
    """What stands in a file: its table, and the acceleration channels that can be chosen."""

    table: Table
    channels: tuple[Channel, ...]


def read(
    raw: bytes | Path,
    filename: str,
    unit: str | None = None,
    dt: float | None = None,
    format: str | None = None,
    channel: int | str | None = None,
) -> Motion:
    """The motion in a file, named after the file. `unit` and `dt` (s) are used where the file does not state them.

    `raw` is the content of the file, or its path: files beside it are read only by its path (StationXML of miniSEED).
    `format` is a key of the formats. `channel` is the name or the number (from 1) of an acceleration channel: needed where
    the file has several. Raises MotionError with every issue: what, where, value, bound and how to mend it.
    """
    table = _table(raw, filename, format)
    offered = _channels(table)
    chosen = _chosen(offered, channel)
    acceleration, step = checked(chosen.column, unit, dt, _peak_agrees(table, chosen.column))
    file = filename.replace("\\", "/").rsplit("/", 1)[-1]
    which = f", channel {chosen.number} of {len(offered)}" if len(offered) > 1 else ""
    component = chosen.name if table.named else ""
    title = table.about.get("title", "")
    return Motion(
        name=slug(PurePath(file).stem),
        title=(f"{title}, {component}" if title and which else title) or PurePath(file).stem or "Motion",
        dt=step,
        acceleration=acceleration,
        provenance=f"read from {file} ({table.format}{which}){_applied(chosen.column, unit)}",
        event=table.about.get("event", ""),
        component=component,
        station=table.about.get("station", ""),
    )


def _applied(column: Column, unit: str | None) -> str:
    """What was done to the numbers of the file, as the end of a sentence; empty where nothing was done."""
    if in_counts(column):
        return f"; (counts - mean) x {unit}; the mean, {np.mean(column.values):.6g} counts, is removed"
    return f"; {column.applied}" if column.applied else ""


def contents(raw: bytes | Path, filename: str, format: str | None = None) -> Contents:
    """The table in a file and its acceleration channels. Raises MotionError where it has none or cannot be read."""
    table = _table(raw, filename, format)
    return Contents(table, _channels(table))


def channels(raw: bytes | Path, filename: str, format: str | None = None) -> tuple[str, ...]:
    """Names of the acceleration channels in a file, in the order of the numbers of `channel`, from 1."""
    return tuple(one.name for one in contents(raw, filename, format).channels)


def check_size(size: int) -> None:
    """Raises MotionError for a file that is larger than the limit."""
    if size > _LARGEST_FILE:
        raise MotionError(Issue("file", f"is larger than {_LARGEST_FILE:,} bytes", size, "cut or resample the record"))


def _table(raw: bytes | Path, filename: str, format: str | None) -> Table:
    source = Source(filename, path=raw) if isinstance(raw, Path) else Source(filename, content=raw)
    check_size(source.size)
    try:
        return registry.read(source, registry.RECORD, format)
    except FileError as error:
        raise MotionError(error.issues) from None


def _channels(table: Table) -> tuple[Channel, ...]:
    """The acceleration channels: those said to be acceleration, else those whose unit fits, else those in counts."""
    said = [one for one in table.columns if one.quantity == "acceleration"]
    unsaid = [one for one in table.columns if not one.quantity]
    possible = said or [one for one in unsaid if _can_be_acceleration(one.unit)] or [one for one in unsaid if in_counts(one)]
    if not possible:
        names = "; ".join(f"{one.name} ({one.quantity or one.unit})" for one in table.columns)
        raise MotionError(Issue("file", "has no channel of acceleration", names, "give the acceleration record"))
    return tuple(Channel(number, column) for number, column in enumerate(possible, start=1))


def _peak_agrees(table: Table, column: Column) -> bool:
    """Whether the header states the peak of the column; a statement that does not agree has refused the file before."""
    pga = float(np.max(np.abs(column.values), initial=0.0))
    stated = (abs(one.read) for one in table.statements if one.what.startswith(_PEAKS))
    return any(abs(one - pga) <= _ROUNDING * pga for one in stated)


def _can_be_acceleration(unit: str) -> bool:
    known = units.named(unit)
    return known is None or units.UNITS[known][0] == "acceleration"


def _chosen(offered: tuple[Channel, ...], channel: int | str | None) -> Channel:
    if channel is None and len(offered) == 1:
        return offered[0]
    asked = str(channel).strip().lower()
    named = [one for one in offered if isinstance(channel, str) and one.name.lower() == asked]
    if channel is not None and (found := named or [one for one in offered if str(one.number) == asked]):
        return found[0]
    listed = "; ".join(f"{one.number}: {one.name}" for one in offered)
    problem = "the file has 1 channel" if len(offered) == 1 else f"the file has {len(offered)} channels"
    raise MotionError(Issue("channel", problem, channel, f"choose one of {listed}"))
