"""What of a file is compared with the other files of its batch: its columns as it states them, and the resulting channels."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.unit_names import Written
from rths_engine.recordings.measured import blocks, names, stated
from rths_engine.recordings.measured.layout import fingerprint
from rths_engine.recordings.measured.mapping import Mapping
from rths_engine.recordings.measured.recording import Measured
from rths_engine.recordings.measured.roles import shown

DIGITS = 6  # of numbers that are compared and shown; chosen, see docs/decisions/0023


@dataclass(frozen=True)
class ColumnFacts:
    """A column: its name, the name without its unit, the unit as the file states it, and what the format says of it."""

    name: str
    plain: str
    unit: str
    quantity: str
    applied: str
    dt: float | None


@dataclass(frozen=True)
class ChannelFacts:
    """A channel of the recording: its largest absolute value and its mean in the unit shown, and whether it is constant."""

    largest: float
    mean: float
    unit: str
    constant: bool


@dataclass(frozen=True)
class RecordingFacts:
    """The recording that a mapping gives: its clock and its channels by their keys."""

    samples: int
    rate_hz: float
    start_s: float
    duration_s: float
    channels: dict[str, ChannelFacts]


@dataclass(frozen=True)
class Facts:
    """A file that can be read. `steps`: of time columns that the mapping leaves out, in the unit of the column, by its name."""

    layout: str
    format: str
    named: bool
    columns: tuple[ColumnFacts, ...]
    steps: dict[str, float] = field(default_factory=dict)
    stated: tuple[str, ...] = ()
    about: dict[str, str] = field(default_factory=dict)
    recording: RecordingFacts | None = None

    def column(self, selector: str | int) -> int | None:
        """The place, from 0, of a column that a mapping names or numbers; None where the file does not have it."""
        if isinstance(selector, int) and 1 <= selector <= len(self.columns):
            return selector - 1
        return next((at for at, one in enumerate(self.columns) if one.name == str(selector)), None)


def of(table: Table, mapping: Mapping) -> Facts:
    """The facts of a table; its recording is added when it has been made."""
    used = {table.column(one.column, "").name for one in mapping.times if _has(table, one.column)}
    used |= {one.time for one in mapping.measurements if one.time is not None}
    return Facts(
        fingerprint(table),
        table.format,
        table.named,
        tuple(_column(one) for one in table.columns),
        {one.name: step for one in table.columns if one.name not in used and (step := _step(one)) is not None},
        tuple(dict.fromkeys(one.what for one in table.statements)),
        table.about,
    )


def of_recording(measured: Measured) -> RecordingFacts:
    """The facts of a recording."""
    channels = {}
    for one in measured.channels:
        extent = blocks.extent(one.values)
        total = sum(float(np.sum(one.values[part])) for part in blocks.parts(len(one.values)))
        (low, high, mean), unit = shown(np.array([extent.low, extent.high, total / len(one.values)]), one.unit)
        largest = rounded(max(abs(low), abs(high)))
        channels[one.key] = ChannelFacts(largest, rounded(mean), unit, extent.low == extent.high)
    duration = rounded((measured.samples - 1) * measured.dt)
    return RecordingFacts(measured.samples, rounded(1 / measured.dt), rounded(measured.start), duration, channels)


def rounded(value: float) -> float:
    """The value as it is compared and shown, with DIGITS digits."""
    return float(f"{value:.{DIGITS}g}")


def _column(one: Column) -> ColumnFacts:
    _, rest, _ = names.stated_unit(one.name, one.unit)
    words, number = names.bare(rest)
    plain = f"{words} {number}" if number is not None else words
    return ColumnFacts(one.name, plain, _unit(stated.unit_of(one)), one.quantity, one.applied, one.dt)


def _unit(written: Written) -> str:
    """The unit that a file states, with its factor; an unknown unit as it is written; empty where there is none."""
    known = written.unit if written.scale == 1.0 else f"{written.scale:g} {written.unit}"
    return known if written.unit else written.text if written.problem else ""


def _step(column: Column) -> float | None:
    """The step of a column that is time by its name, in its own unit; None for other columns."""
    if names.read(column.name, column.unit, column.quantity).role != "t" or len(column.values) < 2:
        return None
    step = float(np.median(np.diff(column.values)))
    return step if np.isfinite(step) and step > 0 else None


def _has(table: Table, selector: str | int) -> bool:
    return str(selector) in table.names or (isinstance(selector, int) and 1 <= selector <= len(table.columns))
