"""Doubts about the time of a recording: a unit that only the mapping states, a sample number, a time column left out."""

from __future__ import annotations

from collections.abc import Mapping as Mapped

import numpy as np

from rths_engine.formats.table import Column, Table
from rths_engine.foundation import units
from rths_engine.recordings.measured import stated
from rths_engine.recordings.measured.clock import Clock, restart, untimed_rows
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.guess_time import counts
from rths_engine.recordings.measured.mapping import ColumnMap, Mapping

# chosen; see docs/decisions/0023
LOWEST, HIGHEST = 1.0, 20_000.0  # Hz: rates of tests
_LONG_UNITS = ("s", "min", "h")


def found(table: Table, mapping: Mapping, clocks: Mapped[str, Clock | None]) -> list[Finding]:
    """A warning for each mapped time column that can be meant otherwise, and for each that is left out and contradicts."""
    doubts: list[Finding] = []
    for channel in mapping.times:
        column = table.column(channel.column, "")
        if (own := clocks.get(column.name)) is not None:
            doubts += _of_unit(column, channel, own)
            doubts += _of_step(table, mapping, column, own)
    return [*doubts, *_of_left_out(table, mapping)]


def _of_unit(column: Column, channel: ColumnMap, own: Clock) -> list[Finding]:
    where, rate = f"t ({column.name})", 1 / own.step
    if channel.unit in _LONG_UNITS and channel.gain is None and counts(column.values):
        first = ", ".join(f"{value:.0f}" for value in column.values[:3])
        fix = "if it is a sample number, leave the column out and give the rate"
        value = f"{first} ...; in {channel.unit}: {rate:.4g} Hz"
        return [Finding("warning", where, "counts like a sample number", value, fix=fix)]
    if not stated.unit_of(column).none or LOWEST <= rate <= HIGHEST:
        return []
    own_scale = own.step / units.factor(channel.unit)
    others = {unit: 1 / (own_scale * units.factor(unit)) for unit in ("s", "ms", "us") if unit != channel.unit}
    fitting = [f"{each:.6g} Hz in {unit}" for unit, each in others.items() if LOWEST <= each <= HIGHEST]
    problem = f"gives a rate of {rate:.6g} Hz in {channel.unit}, the unit of the mapping; the file states none"
    return [Finding("warning", where, problem, "; ".join(fitting), fix="check the unit of time")] if fitting else []


def _of_step(table: Table, mapping: Mapping, column: Column, own: Clock) -> list[Finding]:
    """A warning where the file states another step than the mapped time column has."""
    for channel in mapping.measurements:
        of = table.column(channel.column, "")
        timed = (channel.time or of.time or column.name) == column.name and channel.rate is None
        if timed and of.dt is not None and abs(of.dt - own.step) > 10 * stated.STEP_AGREES * own.step:
            problem = f"has steps of {own.step:.7g} s by the mapping; the file states a time step of {of.dt:.7g} s"
            return [Finding("warning", f"t ({column.name})", problem, fix="check the unit of time")]
    return []


def _of_left_out(table: Table, mapping: Mapping) -> list[Finding]:
    """Findings about a time column in place of which the mapping gives a step: it can show that the rows are not one record."""
    steps = {step for one in mapping.measurements if (step := mapping.step_of(one)) is not None}
    mapped = {table.column(one.column, "").name for one in mapping.channels}
    found: list[Finding] = []
    for column in table.columns if steps else ():
        if column.name in mapped or column.quantity != "time" or column.dt is not None or counts(column.values):
            continue
        where, values = f"t ({column.name})", column.values
        if lacks := untimed_rows(values):
            found.append(Finding("error", where, *lacks, fix="remove these rows from the file"))
        elif (at := restart(values)) is not None:
            value = f"{values[at - 1]:.10g}, then {values[at]:.10g}"
            problem = f"the column, which the mapping leaves out, starts again at sample {at + 1}: a second block of data"
            found.append(Finding("warning", where, problem, value, fix="give each block in a file of its own"))
        elif (own := _step(column)) is not None and all(abs(own[0] - one) > own[1] for one in steps):
            given = f"has steps of {own[0]:.7g} s; the mapping says {min(steps):.7g} s"
            problem = f"the column, which the mapping leaves out, {given}"
            found.append(Finding("warning", where, problem, fix="map the column as t, unless it is wrong"))
    return found


def _step(column: Column) -> tuple[float, float] | None:
    """The mean step (s) of stamps whose unit the file states, and what their rounding explains."""
    written, values = stated.unit_of(column), column.values
    if written.dimension != "time" or len(values) < 2 or not (np.isfinite(values).all() and values[-1] > values[0]):
        return None
    step = float(values[-1] - values[0]) / (len(values) - 1)
    within = max(10 * stated.STEP_AGREES * step, float(np.max(np.diff(values))) / (len(values) - 1))
    factor = written.scale * units.factor(written.unit)
    return step * factor, within * factor
