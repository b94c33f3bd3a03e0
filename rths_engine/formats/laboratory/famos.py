"""imc FAMOS (.raw, .dat): the channels of every data field, scaled by their factor and offset, with own start and step."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime, timedelta

import numpy as np

from rths_engine.formats import damage, stamps
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory.famos_keys import Key, keys
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement, count
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition: numeric type -> how numpy reads it, and kinds of data fields
_TYPES = {1: "u1", 2: "i1", 3: "u2", 4: "i2", 5: "u4", 6: "i4", 7: "f4", 8: "f8", 11: "u2", 12: "u8", 13: "6", 14: "i8"}
_DIGITAL = 11
_REAL, _MONOTONE, _XY = 1, 2, 3
_START_OF_AXIS = 2  # the use of X0 by which the axis, not the buffer, states the start
_STEPS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0}


@dataclass
class _Component:
    """A component: its packing, buffer, range, axis and trigger time, and the names of its channels by bit."""

    where: str
    axis: Key | None
    trigger: Key | None
    packing: Key | None = None
    buffer: Key | None = None
    range: Key | None = None
    channels: list[tuple[int, str, str]] = field(default_factory=list)


def looks_like(source: Source) -> bool:
    """Whether the content is a FAMOS file."""
    return source.head.startswith(b"|CF,")


def read(source: Source) -> Table:
    """Read the file. Raises FileError where a key does not follow the format or the samples are incomplete."""
    with damage.refused("FAMOS"):
        return _table(source.bytes())


def _table(raw: bytes) -> Table:
    found = list(keys(raw))
    first = found[0]
    if first.name != "CF" or first.version != 2:
        raise FileError(Issue("byte 0", f"is FAMOS of version {first.version}", fix="save it again with imc FAMOS 5 or later"))
    big = first.fields()[-1] == "2"
    blocks = {one.whole(0): one for one in found if one.name == "CS"}
    fields, about = _fields(found)
    columns: list[Column] = []
    notes: list[str] = []
    statements: list[Statement] = []
    triggers = [_moment(one) for _, components in fields for one in components]
    first_trigger = min((one for one in triggers if one is not None), default=None)
    for kind, components in fields:
        names = ", ".join(name for one in components for _, name, _ in one.channels)
        if kind not in (_REAL, _MONOTONE, _XY):
            notes.append(f"{names or 'a data field'} contains complex numbers: left out")
        elif kind == _REAL:
            for one in components:
                columns += _equal(raw, one, blocks, big, first_trigger, statements, notes)
        else:
            columns += _pairs(raw, components, blocks, big, statements)
    header = "\n".join(f"|{one.name},{one.version}: {one.text}" for one in found if one.name not in ("CS", "CK"))
    return Table("FAMOS", distinct(columns), notes=tuple(notes), statements=tuple(statements), header=header, about=about)


def _fields(found: list[Key]) -> tuple[list[tuple[int, list[_Component]]], dict[str, str]]:
    """Kind and components of each data field. An axis or a trigger time before a component holds for those that follow."""
    fields: list[tuple[int, list[_Component]]] = []
    about: dict[str, str] = {}
    axis = trigger = None
    for key in found:
        last = fields[-1][1][-1] if fields and fields[-1][1] else None
        if key.name == "CG":
            fields.append((key.whole(1), []))
            axis = trigger = None
        elif key.name == "CD":
            axis = key
        elif key.name == "NT":
            trigger = key
        elif key.name == "NO":
            about["origin"] = key.texts(2)[0]
        elif key.name == "CC":
            if not fields:
                fields.append((_REAL, []))
            fields[-1][1].append(_Component(key.where, axis, trigger))
        elif last is not None and key.name in ("CP", "Cb", "CR"):
            setattr(last, {"CP": "packing", "Cb": "buffer", "CR": "range"}[key.name], key)
        elif last is not None and key.name == "CN":
            name, comment = key.texts(3)[:2]
            last.channels.append((key.whole(2), name, comment))
        if last is not None and key.name in ("CD", "NT") and last.buffer is None:
            setattr(last, "axis" if key.name == "CD" else "trigger", key)
    return fields, about


def _equal(
    raw: bytes,
    one: _Component,
    blocks: dict[int, Key],
    big: bool,
    first: datetime | None,
    statements: list[Statement],
    notes: list[str],
) -> Iterator[Column]:
    values, start = _samples(raw, one, blocks, big, statements)
    unit, applied = _range(one)
    step, axis_unit = _axis(one)
    factor = _STEPS.get(axis_unit.lower())
    begun = _moment(one)
    for bit, name, _ in one.channels:
        own = (values.astype(int) >> (bit - 1)) & 1 if bit else values
        column = Column(name, np.asarray(own, dtype=float), "" if bit else unit, applied=applied)
        if factor is None or step <= 0:
            notes.append(f"{name} is recorded over {axis_unit or 'an axis without a unit'}, in steps of {step:g}")
            yield column
            continue
        later = (begun - first).total_seconds() if begun is not None and first is not None else 0.0
        yield replace(column, dt=step * factor, start=start * factor + later)


def _pairs(
    raw: bytes, components: list[_Component], blocks: dict[int, Key], big: bool, statements: list[Statement]
) -> Iterator[Column]:
    """Value and time of each sample: the first component is the value, the second its time."""
    if len(components) != 2:
        raise FileError(
            Issue(components[0].where if components else "file", f"has {len(components)} components; XY data have 2")
        )
    y, x = components
    (values, _), (times, _) = _samples(raw, y, blocks, big, statements), _samples(raw, x, blocks, big, statements)
    (unit, applied), (of_time, applied_to_time) = _range(y), _range(x)
    name = next((name for one in (y, x) for _, name, _ in one.channels), "channel")
    statements.append(count(len(times), len(values), y.where, name))
    factor = _STEPS.get(of_time.lower())
    column = Column(name, values, unit, applied=applied)
    if factor is None:
        yield from (Column(f"x of {name}", times, of_time, applied=applied_to_time), column)
        return
    yield from stamps.timed([column], Column(f"time of {name}", times * factor, "s", applied=applied_to_time))


def _samples(
    raw: bytes, one: _Component, blocks: dict[int, Key], big: bool, statements: list[Statement]
) -> tuple[Array, float]:
    """The scaled values of a component, and the axis value of the first one."""
    if one.packing is None or one.buffer is None:
        raise FileError(Issue(one.where, "has no packing (CP) or no buffer (Cb)", fix="the file is damaged: export it again"))
    if one.buffer.whole(0) != 1:
        fix = "export each trigger event to a file of its own"
        raise FileError(Issue(one.buffer.where, f"has {one.buffer.whole(0)} buffers (trigger events)", fix=fix))
    index, at, length, ring, filled = (one.buffer.whole(k) for k in (3, 4, 5, 6, 7))
    start = one.buffer.real(9)
    if one.axis is not None and one.axis.version == 2 and one.axis.whole(8) == _START_OF_AXIS:
        start = one.axis.real(7)
    block = blocks.get(index)
    if block is None:
        raise FileError(Issue(one.buffer.where, f"names a block of samples, {index}, that the file does not have"))
    body = block.body(1)
    statements.append(Statement("end of its samples", one.buffer.where, max(at + filled, len(body)), len(body), "bytes"))
    held = body[at : at + length]
    held = (held[ring:] + held[:ring])[:filled] if ring else held[:filled]
    _, size, kind, bits, _, offset, group, gap = (one.packing.whole(k) for k in range(8))
    form = _TYPES.get(kind)
    if form is None:
        problem = {9: "a transitional recording", 10: "time stamps as text"}.get(kind, f"numbers of the unknown type {kind}")
        raise FileError(Issue(one.packing.where, f"contains {problem}", fix="export it as real numbers"))
    if (size * 8 != bits and kind != _DIGITAL) or size != int(form[-1]):
        raise FileError(Issue(one.packing.where, f"states {size} bytes and {bits} bits for the type {kind}"))
    values = _numbers(_apart(held[offset:], size, max(1, group), gap), form, big)
    refuse_many(len(values))
    if one.range is not None and one.range.whole(0) == 1:
        values = values * one.range.real(1) + one.range.real(2)
    return values, start


def _apart(held: bytes, size: int, group: int, gap: int) -> bytes:
    """The samples of a component between those of others: `group` samples, then `gap` bytes to skip."""
    if gap == 0:
        return held[: len(held) // size * size]
    row = size * group + gap
    return b"".join(held[at : at + size * group] for at in range(0, len(held) - size * group + 1, row))


def _numbers(held: bytes, form: str, big: bool) -> Array:
    order = ">" if big else "<"
    if form != "6":
        return np.frombuffer(held, order + form).astype(float)
    six = np.frombuffer(held, "u1").reshape(-1, 6).astype(float)
    return np.asarray(six @ 256.0 ** np.arange(6)[:: -1 if big else 1], dtype=float)


def _range(one: _Component) -> tuple[str, str]:
    """Unit, and the factor and offset that were applied."""
    if one.range is None:
        return "", ""
    unit = one.range.texts(4)[0].strip()
    if one.range.whole(0) != 1:
        return unit, ""
    return unit, f"raw x {one.range.real(1):g} + {one.range.real(2):g}"


def _axis(one: _Component) -> tuple[float, str]:
    return (one.axis.real(0), one.axis.texts(2)[0].strip()) if one.axis is not None else (0.0, "")


def _moment(one: _Component) -> datetime | None:
    """The time of the trigger, with the time that the buffer adds to it."""
    if one.trigger is None:
        return None
    day, month, year, hour, minute = (one.trigger.whole(k) for k in range(5))
    added = one.buffer.real(10) if one.buffer is not None else 0.0
    try:
        return datetime(year, month, day, hour, minute, tzinfo=UTC) + timedelta(seconds=one.trigger.real(5) + added)
    except (ValueError, OverflowError):
        return None


FORMAT = Format(
    key="famos",
    title="imc FAMOS",
    of="measurement",
    extensions=("raw", "dat"),
    defined="FAMOS file format, imc Test & Measurement",
    header="channel names, units, factors, offsets, start and step, trigger times",
    compared="bytes of each component, number of times and values",
    looks_like=looks_like,
    read=read,
    public=81,
    public_check="IMCtermite 2.1.18; of two more files it gives words instead of bits, one is damaged and refused",
)
