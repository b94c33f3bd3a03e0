"""Statistics and decimated channels of a table or a recording, in the units shown."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import (
    Column,
    Examined,
    Finding,
    Mapping,
    Measured,
    MeasuredChannel,
    Signal,
    release,
    same_motion,
    stated,
)
from rths_engine.recordings.measured.roles import ROLES, UNITS, dimension, shown
from rths_engine.results.decimate import extremes

BUCKETS = 700  # about the width of a plot in pixels
LOOP_POINTS = 4000
DIGITS = 7


@dataclass(frozen=True)
class Part:
    """A part of the time, from `start` to `stop` (s); None: without limit."""

    start: float | None = None
    stop: float | None = None

    @property
    def whole(self) -> bool:
        return self.start is None and self.stop is None

    def within(self, times: Array) -> slice:
        """The samples at these times; `times` increase."""
        first = 0 if self.start is None else int(np.searchsorted(times, self.start))
        after = len(times) if self.stop is None else int(np.searchsorted(times, self.stop, side="right"))
        return slice(first, max(first, after))


WHOLE = Part()


def roles() -> dict[str, Any]:
    """The roles that a column can have, each with its dimensions, and all units by dimension."""
    units: dict[str, list[str]] = {}
    for unit in UNITS:
        units.setdefault(dimension(unit), []).append(unit)
    fields = {name: {"label": role.label, "counts": role.counts, "dimensions": role.dimensions} for name, role in ROLES.items()}
    return {"roles": fields, "units": units}


def column(one: Column) -> dict[str, Any]:
    """A column of a file with its unit, its number of samples and its statistics.

    `unit` is as the file writes it, `stated` the unit of the table that it names, `problem` why it names none.
    """
    known = one.values[np.isfinite(one.values)]
    missing = len(one.values) - len(known)
    release(one.values)
    written = stated.unit_of(one)
    unit = {"unit": one.unit, "stated": written.plain, "problem": written.problem, "applied": one.applied}
    clock = {"samples": len(one.values), "missing": missing, "dt_s": one.dt, "start_s": one.start}
    return {"name": one.name, "quantity": one.quantity, **unit, **clock, **_statistics(known)}


def examined(found: Examined, mapping: Mapping, part: Part = WHOLE) -> dict[str, Any]:
    """The channels by a mapping, and the findings about them. There are no channels if the time or the values are invalid.

    Lags between channels are found for the whole of the time only.
    """
    findings = [{**one.as_dict(), "column": _column(one, mapping)} for one in found.findings]
    measured = found.measured if part.whole else None
    lags = [] if measured is None else [one.as_dict() for one in same_motion.found(measured, mapping, found.signals)]
    about = {"mapping": mapping.as_dict(), "findings": findings, "lags": lags}
    return {**about, **preview(found.measured, found.signals, part)}


def preview(measured: Measured | None, signals: Sequence[Signal] = (), part: Part = WHOLE) -> dict[str, Any]:
    """Decimated channels and force-displacement loops of a recording; empty without a recording.

    Where `signals` are given, a channel shows the samples of the file at their own times, not those of the common clock.
    """
    own = {one.channel.key: one for one in signals}
    if measured is None:
        return {"channels": [], "loops": [], "samples": None, "dt_s": None, "start_s": None}
    channels = [_decimated(one, measured, own.get(one.key), part) for one in measured.channels]
    loops = [_loop(measured, number) for number in measured.numbers("station") if _moved(measured, number)]
    clock = {"samples": measured.samples, "dt_s": measured.dt, "start_s": measured.start}
    return {"channels": channels, "loops": loops, **clock}


def described(one: MeasuredChannel) -> dict[str, Any]:
    """A channel without its samples, with `unit` and statistics in the unit shown."""
    values, unit = shown(one.values, one.unit)
    release(one.values)
    named = {"key": one.key, "role": one.role, "number": one.number, "label": one.label, "column": one.column}
    return {**named, "moved": one.moved, "unit": unit, **_statistics(values)}


def _decimated(one: MeasuredChannel, measured: Measured, own: Signal | None, part: Part) -> dict[str, Any]:
    """A channel with its samples in a part of the time: all of them, or the extremes of equal parts where there are many."""
    times, samples = (measured.time, one.values) if own is None else (own.clock.times, own.values)
    inside = part.within(times)
    times, values = times[inside], shown(samples, one.unit)[0][inside]
    release(samples)
    kept = extremes(values[:, None], BUCKETS) if len(values) else np.arange(0)
    told = {"samples": len(values), "time": _rounded(times[kept], 9), "values": _rounded(values[kept], DIGITS)}
    return {**described(one), **told}


def _moved(measured: Measured, number: int) -> bool:
    return measured.has("x_meas", number) and measured.has("f_meas", number)


def _loop(measured: Measured, number: int) -> dict[str, Any]:
    """Force against displacement of a station, every n-th sample."""
    every = -(-measured.samples // LOOP_POINTS)
    x, x_unit = shown(measured.get("x_meas", number)[::every], "m")
    y, y_unit = shown(measured.get("f_meas", number)[::every], "N")
    points = {"x": _rounded(x, DIGITS), "y": _rounded(y, DIGITS)}
    return {"station": number, **points, "x_unit": x_unit, "y_unit": y_unit}


def _statistics(values: Array) -> dict[str, float | None]:
    if not len(values):
        return {"smallest": None, "largest": None, "mean": None}
    with np.errstate(over="ignore"):
        found = {"smallest": np.min(values), "largest": np.max(values), "mean": np.mean(values)}
    return {name: _finite(float(value)) for name, value in found.items()}


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _rounded(values: Array, digits: int) -> list[float | None]:
    return [_finite(float(f"{value:.{digits}g}")) for value in values]


def _column(finding: Finding, mapping: Mapping) -> str | int | None:
    """The column that a finding is about, or None; a finding about a time column names the column itself."""
    for channel in mapping.channels:
        if finding.channel in {channel.key, f"t ({channel.column})"}:
            return channel.column
    return None
