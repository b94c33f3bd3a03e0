"""Import of a table with its mapping: conversion to SI, checks, and resampling to one uniform step."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rths_engine.formats.numeric_block import MOST_VALUES
from rths_engine.formats.scratch import kept, on_disk, release
from rths_engine.formats.table import MOST_SAMPLES, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue, MeasuredError
from rths_engine.recordings.measured import blocks, checks, clock, mapping_yaml, pairs, stated, time_doubts
from rths_engine.recordings.measured.blocks import Extent
from rths_engine.recordings.measured.clock import Clock
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.mapping import ColumnMap, Mapping
from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.resample import described, resampled
from rths_engine.recordings.measured.roles import ROLES, SI, dimension, to_si

# chosen; see docs/decisions/0023
LEAST = 8  # samples of a recording
SHORTEST, LONGEST = 1e-9, 1e9  # step, s
LOST = 0.01  # share of a channel's time that other channels lack, from which a warning is given


@dataclass(frozen=True)
class Signal:
    """The samples of a file for one channel, in SI, at their own times, before they are put on the clock of the recording."""

    channel: ColumnMap
    values: Array
    clock: Clock


@dataclass(frozen=True)
class Examined:
    """The result of an import. `measured` is None where the time cannot be used or values are missing."""

    measured: Measured | None
    findings: tuple[Finding, ...]
    signals: tuple[Signal, ...] = ()

    @property
    def errors(self) -> tuple[Finding, ...]:
        return tuple(one for one in self.findings if one.severity == "error")


def imported(table: Table, mapping: Mapping, source: str = "", sha256: str = "") -> Measured:
    """The measured recording, which stores all warnings. Raises MeasuredError with every error."""
    examined = examine(table, mapping, source, sha256)
    if examined.measured is None or examined.errors:
        raise MeasuredError(one.issue for one in examined.errors)
    return examined.measured


@np.errstate(over="ignore", invalid="ignore")
def examine(table: Table, mapping: Mapping, source: str = "", sha256: str = "") -> Examined:
    """The recording with all findings, errors included. Raises MeasuredError where the mapping does not fit the file."""
    check(table, mapping)
    findings = stated.differing(table, mapping)
    clocks: dict[str, Clock | None] = {}
    timed: list[tuple[ColumnMap, Clock, list[Finding]]] = []
    for index, channel in enumerate(mapping.channels):
        if channel.role != "t" and (own := _clock(table, mapping, channel, index, clocks, findings)) is not None:
            timed.append((channel, clock.shifted(own, -channel.lag) if channel.lag else own, findings))
            findings = []
    findings += time_doubts.found(table, mapping, clocks)
    large = any(on_disk(column.values) for column in table.columns)
    seen = blocks.each(lambda one: _signal(table, *one[:2]), timed, large)
    findings = [*(one for (_, _, before), (_, found) in zip(timed, seen, strict=True) for one in before + found), *findings]
    signals = [signal for signal, _ in seen if signal is not None]
    if len(signals) < len(mapping.measurements):
        return Examined(None, tuple(findings), tuple(signals))
    start, count, dt = _grid(mapping, [one.clock for one in signals])
    findings += _lost(signals, start, start + (count - 1) * dt, mapping)
    channels = tuple(_channel(one, start, count, dt) for one in signals)
    findings += pairs.contradictions({one.key: one.values for one in channels}, dt)
    warnings = tuple(one for one in findings if one.severity == "warning")
    text = mapping_yaml.write(mapping)
    measured = Measured(dt, channels, start, mapping.title, mapping.test, source, sha256, text, warnings)
    return Examined(measured, tuple(findings), tuple(signals))


@np.errstate(over="ignore", invalid="ignore")
def _signal(table: Table, channel: ColumnMap, own: Clock) -> tuple[Signal | None, list[Finding]]:
    """The samples of a channel, and findings about them; None where they cannot be used."""
    unit = _unit(channel)
    column = table.column(channel.column, "").values
    values, extent, found = checks.filled(*_si(column, channel), own.times, channel.key)
    if on_disk(column) and not on_disk(values):
        values = kept(values)
    found += checks.too_large(values, extent, channel.key, unit)
    if any(one.severity == "error" for one in found):
        return None, found
    found += checks.shape(values, extent, own.times, channel.key, unit)
    release(values)
    return Signal(channel, values, own), found


def check(table: Table, mapping: Mapping) -> None:
    """Raises MeasuredError where the mapping is incomplete or names columns that the file does not have."""
    issues: list[Issue] = []
    for index, channel in enumerate(mapping.channels):
        if lacks := channel.lacks:
            issues.append(replace(lacks, where=f"mapping.channels.{index}.{lacks.where}"))
        for name in (channel.column, channel.time):
            try:
                if name is not None:
                    table.column(name, f"mapping.channels.{index}")
            except FileError as error:
                issues += error.issues
    if issues:
        raise MeasuredError(issues)


def _clock(
    table: Table, mapping: Mapping, channel: ColumnMap, index: int, clocks: dict[str, Clock | None], findings: list[Finding]
) -> Clock | None:
    """The clock of a channel: its own time column, else that of the mapping, else the mapping's step, else the file's step."""
    column = table.column(channel.column, "")
    count = len(column.values)
    stamps = _stamps(table, mapping, channel, index)
    if stamps is not None and channel.rate is None:
        times = table.column(stamps.column, "")
        if times.name not in clocks:
            clocks[times.name], found = clock.of_stamps(_si(times.values, stamps)[0], f"t ({times.name})")
            findings += found
        if len(times.values) == count:
            return clocks[times.name]
        if mapping.step is None and column.dt is None:
            problem = f"has {count} samples, its time column {times.name} has {len(times.values)}"
            fix = "give the channel its own rate or time column, or leave it out"
            raise MeasuredError(Issue(f"mapping.channels.{index}", problem, column.name, fix))
    step = 1 / channel.rate if channel.rate else mapping.step or column.dt
    if step is None:
        fix = "map a column as t, or give dt (s) or rate (Hz)"
        raise MeasuredError(Issue("mapping.rate", "neither the file nor the mapping states the time step", fix=fix))
    if not SHORTEST <= step <= LONGEST:
        bound = f"needs a time step of {SHORTEST:g} to {LONGEST:g} s"
        raise MeasuredError(Issue("mapping.rate", bound, f"{step:g} s", "check its unit"))
    if count < 2:
        raise MeasuredError(Issue(f"mapping.channels.{index}", f"has {count} samples; it needs at least 2", column.name))
    return clock.of_step(step, count, column.start)


def _stamps(table: Table, mapping: Mapping, channel: ColumnMap, index: int) -> ColumnMap | None:
    """The time column of a channel: its own of the mapping, else its own of the file, else the mapping's first one.

    The mapping's first one is not taken where the file assigns it to other columns only. Raises MeasuredError where a column of
    its own is not mapped as t and the file does not state its unit.
    """
    name = channel.time or table.column(channel.column, "").time
    if not name:
        first = mapping.times[0] if mapping.times else None
        assigned = first is not None and any(one.time == table.column(first.column, "").name for one in table.columns)
        return None if assigned else first
    own = next((one for one in mapping.times if table.column(one.column, "").name == name), None)
    if own is not None:
        return own
    written = stated.unit_of(table.column(name, ""))
    if written.dimension != "time":
        problem = "the file does not state the unit of this time column"
        fix = f"map the column as t with its unit: {{column: '{name}', role: t, unit: s}}"
        raise MeasuredError(Issue(f"mapping.channels.{index}.time", written.problem or problem, name, fix))
    gain = None if written.scale == 1.0 else repr(written.scale)
    return ColumnMap(column=name, role="t", unit=written.unit, gain=gain)


def _si(values: Array, channel: ColumnMap) -> tuple[Array, Extent]:
    gain, unit = channel.scale
    factor, zero = to_si(unit)
    sign = -1.0 if channel.reverse else 1.0
    return blocks.scaled(values, sign * factor * gain, channel.offset, zero)


def _unit(channel: ColumnMap) -> str:
    """The SI unit of the channel."""
    return SI[dimension(channel.scale[1])]


def _grid(mapping: Mapping, clocks: list[Clock]) -> tuple[float, int, float]:
    """Start (s), number of samples and step (s) of the recording: the time that all channels share, within start and stop."""
    dt = 1 / mapping.target_rate if mapping.target_rate else min(one.step for one in clocks)
    begin, end = max(one.start for one in clocks), min(one.last for one in clocks)
    if mapping.start is not None and mapping.start > begin:
        step = clocks[0].step
        begin = clocks[0].start + np.ceil((mapping.start - clocks[0].start) / step - 1e-6) * step
    if mapping.stop is not None:
        end = min(end, mapping.stop)
    steps = (end - begin) / dt
    if not np.isfinite(steps):
        given = f"{begin:g} s to {end:g} s in steps of {dt:g} s"
        problem = "time, step, start or stop is out of range"
        raise MeasuredError(Issue("mapping", problem, given, "check their units"))
    count = int(np.floor(steps + 1e-3)) + 1
    if count < LEAST:
        given = f"{begin:g} s to {end:g} s in steps of {dt:g} s"
        problem = f"leave {max(0, count)} samples; a recording needs at least {LEAST}"
        raise MeasuredError(Issue("mapping.start, stop and target_rate", problem, given, "give a longer time or a higher rate"))
    most = MOST_VALUES if any(on_disk(one.times) for one in clocks) else MOST_SAMPLES
    if count * len(clocks) > most:
        problem = f"gives {count * len(clocks):,} samples; the maximum is {most:,}"
        raise MeasuredError(Issue("mapping.target_rate", problem, f"{1 / dt:g} Hz", "choose a lower rate"))
    return float(begin), count, dt


def _lost(signals: list[Signal], begin: float, end: float, mapping: Mapping) -> list[Finding]:
    found = []
    for one in signals:
        channel, own = one.channel, one.clock
        first = max(own.start, mapping.start if mapping.start is not None else -np.inf)
        last = min(own.end, mapping.stop if mapping.stop is not None else np.inf)
        beyond = max(0.0, begin - first) + max(0.0, last - end)
        if beyond > LOST * (last - first) and beyond > 2 * own.step:
            problem = (
                "was measured at times at which other channels were not; the recording contains only the time that all share"
            )
            found.append(Finding("warning", channel.key, problem, f"{beyond:.4g} s left out", float(first)))
    return found


def _moved(signal: Signal, start: float, count: int, dt: float) -> str:
    """How the samples of a channel came to the clock of the recording; empty where they are the samples of the file."""
    lag = signal.channel.lag
    parts = [f"times reduced by a lag of {1e3 * lag:.6g} ms"] if lag else []
    return "; ".join(filter(None, [*parts, described(signal.clock, start, count, dt)]))


def _channel(signal: Signal, start: float, count: int, dt: float) -> MeasuredChannel:
    channel = signal.channel
    values = resampled(signal.values, signal.clock, start, count, dt)
    if on_disk(signal.values) and not on_disk(values):
        values = kept(values)
    release(signal.values)
    role = ROLES[channel.role]
    number = (channel.number or 1) if role.counts else None
    label = channel.label or (f"{role.label}, {role.counts} {number}" if number else role.label)
    moved = _moved(signal, start, count, dt)
    return MeasuredChannel(channel.role, number, values, _unit(channel), label, str(channel.column), moved)
