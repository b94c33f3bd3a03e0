"""ASAM MDF 3 and 4: each channel with the time stamps of its own group, and never on the time of another one."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from rths_engine.formats import damage, optional, stamps
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9}  # by definition s; files differ
_TIME = 1  # by definition, MDF 4: the master channel holds times
_NONE_4, _NONE_3 = 0, 65535  # by definition: the conversion that changes nothing
_RANGE_4, _RANGE_3 = 0x08, 1  # by definition: the flag by which the range of the raw values is valid


def looks_like(source: Source) -> bool:
    """Whether the content is an MDF file."""
    return source.head.startswith((b"MDF     ", b"UnFinMF "))


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    if source.head.startswith(b"UnFinMF"):
        fix = "finalise it with the recording program, so that its numbers of samples are right"
        raise FileError(Issue("file", "is an MDF file that was not closed", fix=fix))
    asammdf = optional.package("asammdf", "an MDF file")
    with damage.refused("MDF"), asammdf.MDF(io.BytesIO(source.bytes())) as file:
        return _table(file)


def _table(file: Any) -> Table:
    refuse_many(sum(group.channel_group.cycles_nr * len(group.channels) for group in file.groups))
    columns: list[Column] = []
    notes: list[str] = []
    statements: list[Statement] = []
    for number, group in enumerate(file.groups):
        found = list(_group(file, number, group, notes, statements))
        columns += found
    about = {"version": str(file.version), "begun": str(file.header.start_time)}
    header = str(getattr(file.header, "comment", "") or "")
    return Table("MDF", distinct(columns), notes=tuple(notes), statements=tuple(statements), header=header, about=about)


def _group(file: Any, number: int, group: Any, notes: list[str], statements: list[Statement]) -> Iterator[Column]:
    stated = group.channel_group.cycles_nr
    title = getattr(group.channel_group, "acq_name", "") or f"group {number + 1}"
    if stated == 0:
        notes.append(f"{title} contains no samples")
        return
    master = file.masters_db.get(number)
    several = len(file.groups) > 1
    columns = []
    for index, channel in enumerate(group.channels):
        if index == master:
            continue
        where = f"channel {channel.name}"
        signal = file.get(group=number, index=index, ignore_invalidation_bits=True)  # else it drops the samples
        statements.append(count(stated, len(signal.samples), where, channel.name))
        if signal.samples.dtype.kind not in "fiub" or signal.samples.ndim != 1:
            notes.append(f"{where} contains no single number for each sample")
            continue
        statements += _range(file, number, index, channel)
        values = signal.samples.astype(float)
        if signal.invalidation_bits is not None and np.any(signal.invalidation_bits):
            values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
            notes.append(f"{where}: samples that the file marks as not valid are missing")
        name = f"{channel.name} ({title})" if several and _elsewhere(file, number, channel.name) else channel.name
        columns.append(Column(name, values, signal.unit or "", applied=_applied(channel)))
    if master is None or not columns:
        yield from columns
        return
    times = file.get(group=number, index=master)
    if getattr(group.channels[master], "sync_type", _TIME) != _TIME:
        notes.append(f"{title} is recorded over {times.name}, not over time")
        yield from [Column(f"{times.name} ({title})", times.samples.astype(float), times.unit or ""), *columns]
        return
    name = f"{times.name} ({title})" if several else times.name
    factor = _SECONDS.get(times.unit or "s")
    if factor is None:
        notes.append(f"{title}: the unit of its time stamps, {times.unit}, is not known")
        yield from [
            Column(name, times.samples.astype(float), times.unit, quantity="time"),
            *(replace(one, time=name) for one in columns),
        ]
        return
    yield from stamps.timed(columns, Column(name, times.samples.astype(float) * factor, "s"))


def _elsewhere(file: Any, number: int, name: str) -> bool:
    return any(group != number for group, _ in file.channels_db.get(name, ()))


def _range(file: Any, number: int, index: int, channel: Any) -> list[Statement]:
    """The range of the raw values that the file states, where the data leave it."""
    given = (
        getattr(channel, "flags", 0) & _RANGE_4 if hasattr(channel, "flags") else getattr(channel, "range_flag", 0) == _RANGE_3
    )
    if not given:
        return []
    low, high = float(channel.min_raw_value), float(channel.max_raw_value)
    raw = file.get(group=number, index=index, raw=True).samples
    least, most = float(np.min(raw)), float(np.max(raw))
    where = f"channel {channel.name}"
    found = [Statement("smallest raw value", where, low, least)] if least < low < high else []
    return [*found, *([Statement("largest raw value", where, high, most)] if most > high > low else [])]


def _applied(channel: Any) -> str:
    law = getattr(channel, "conversion", None)
    if law is None or law.conversion_type == (_NONE_4 if hasattr(channel, "flags") else _NONE_3):
        return ""
    a, b = getattr(law, "a", None), getattr(law, "b", None)
    return f"raw x {a:g} + {b:g}" if isinstance(a, float) and isinstance(b, float) else "the conversion of the channel"


FORMAT = Format(
    key="mdf",
    title="ASAM MDF 3 and 4",
    of="measurement",
    extensions=("mf4", "mdf", "dat"),
    defined="ASAM MDF 4, and MDF 3 of Vector Informatik",
    header="channel names, units, conversions, time stamps of each group",
    compared="number of samples, range of raw values",
    looks_like=looks_like,
    read=read,
    public=8,
    public_check="mdfreader 4.3; two more are not closed and one is above the largest size: they are refused",
    library="asammdf (extra `formats`)",
    apart=True,
)
