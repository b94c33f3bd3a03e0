"""Channels of one segment of a LabVIEW measurement file: values, step and start, each beside what the header states."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from rths_engine.formats.laboratory.lvm_segments import File, Segment
from rths_engine.formats.laboratory.rows import Line, decimal_sign, fields, number, up_to_last, values
from rths_engine.formats.statement import Statement, Written, count, step
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_DIGIT = 5e-7  # s: X_Value has six decimals
_EVEN = 1e-3  # of a step: time stamps with equal steps differ less, beside their rounding

_X, _COMMENT = "X_Value", "Comment"


@dataclass(eq=False)
class Channel:
    """A channel of a segment. `start`: X0; `began`: date and time in s; `times`: time stamps with unequal steps."""

    name: str
    unit: str
    values: Array
    dt: float | None
    start: float
    began: float | None
    times: Array | None = None


@dataclass
class Channels:
    """The channels of a segment, what its header states, and notes for people."""

    channels: list[Channel] = field(default_factory=list)
    statements: list[Statement] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def channels_of(segment: Segment, file: File) -> Channels:
    """The channels of a segment. Raises FileError with the line for rows that do not follow the header."""
    labels = segment.labels
    last = len(labels) - 1 if labels and labels[-1] == _COMMENT else len(labels)
    xs = [k for k in range(last) if labels[k] == _X]
    ys = [k for k in range(last) if labels[k] != _X]
    if not ys:
        fix = "the line after the header names the columns: X_Value, the channels, Comment"
        raise FileError(Issue(f"line {segment.at}" if segment.at else "file", "names no channel", "\t".join(labels), fix))
    rows = segment.rows
    decimal = file.header.get("Decimal_Separator") or decimal_sign(rows, file.separator)
    without_x = xs[:1] == [0] and not any(fields(text, file.separator)[0] for _, text in rows)
    used = ys if without_x else xs + ys
    names = [labels[k] for k in used]
    table, empty = values(rows, file.separator, decimal, used, range(min(used[-1], 1) + 1, len(labels) + 2), names)
    found = Channels(notes=_comments(rows, file.separator, last))
    place = {k: column for column, k in enumerate(used)}
    if (announced := _written(segment, "Channels", 1, decimal)) is not None:
        found.statements.append(Statement("number of channels", announced.where, announced.value, len(ys)))
    for k in ys:
        own = up_to_last(table[:, place[k]], empty[:, place[k]], rows, labels[k])
        x_at = max((x for x in xs if x < k), default=None)
        own_x = x_at is not None and (len(xs) > 1 or _shares(segment, ys[0], k))
        x = table[: len(own), place[x_at]] * _scale_x(segment, k) if x_at is not None and own_x and not without_x else None
        _add(found, segment, file, k, own, x, decimal)
    if segment.breaks and any(one.times is None for one in found.channels):
        fix = "write the file with one header for each segment"
        raise FileError(
            Issue(f"line {segment.breaks[0]}", "starts new rows without a header: their time is not stated", fix=fix)
        )
    return found


def _add(found: Channels, segment: Segment, file: File, k: int, own: Array, x: Array | None, decimal: str) -> None:
    """One channel with its statements."""
    _check_unit(segment, k)
    name = segment.labels[k]
    samples = _written(segment, "Samples", k, decimal)
    delta, x0 = (_in_seconds(_written(segment, key, k, decimal), _scale_x(segment, k)) for key in ("Delta_X", "X0"))
    several = samples is not None and file.header.get("Multi_Headings") == "No" and _holds(samples.value, len(own))
    packets = several and x is not None and _rises(x)
    if samples is not None and samples.value == 0 and not len(own):
        found.notes.append(f"{name} has no samples")
        return
    if samples is not None and several:
        packed = f"{len(own) / samples.value:g} packets of {samples.value:g} samples under one header"
        unstated = "whether time goes on between them is not stated; give the rate where it does"
        found.notes.append(f"{packed}: " + (f"their times are in {_X}" if packets else unstated))
    elif samples is not None:
        found.statements.append(count(int(samples.value), len(own), samples.where, name))
    if x is not None and len(x) > 1 and not _rises(x):
        back = int(np.flatnonzero(~(np.diff(x) > 0))[0]) + 1
        at = segment.rows[back][0]
        problem = f"{_X} goes from {x[back - 1]:g} to {x[back]:g}: a new part starts here, whose time is not stated"
        raise FileError(Issue(f"line {at}", problem, fix="write the file with one header for each segment"))
    first = x0.value if x0 is not None else 0.0
    other = segment.stated("X_Dimension", k)[0]
    label = segment.stated("X_Unit_Label", k)[0]
    if other not in {"", "Time"} or (label and unit_names.read(label).dimension != "time"):
        over = f"{other} in {label}" if label and other else other or f"X in {label}"
        found.notes.append(f"{name} is over {over}, not over time")
        found.channels.append(Channel(name, segment.stated("Y_Unit_Label", k)[0], own, None, 0.0, None, x))
        return
    dt, times = _clock(found, delta, x, packets and samples is not None and samples.value == 1)
    dt = None if several and x is None else dt
    if x is not None and len(x) and x0 is not None and not packets:
        within = x0.within + _DIGIT
        found.statements.append(Statement(f"time of the first sample of {name}", x0.where, x0.value, float(x[0]), "s", within))
    if x is None and dt is not None and delta is not None and delta.within * len(own) > 0.5 * dt:
        off = f"{delta.within * len(own):.2g} s at the end of the record"
        found.notes.append(f"Delta_X = {delta.value:g} is rounded, so that time is uncertain by {off}: {_rate(delta)}")
    start = float(x[0]) if x is not None and len(x) and x0 is None else first
    unit = segment.stated("Y_Unit_Label", k)[0]
    found.channels.append(Channel(name, unit, own, dt, start, segment.began(k), times))


def _scale_x(segment: Segment, k: int) -> float:
    """Seconds in one unit of X of a channel, as X_Unit_Label states it; LabVIEW writes seconds where it states none."""
    written = unit_names.read(segment.stated("X_Unit_Label", k)[0])
    return written.scale * units.factor(written.unit) if written.dimension == "time" else 1.0


def _in_seconds(one: Written | None, scale: float) -> Written | None:
    return Written(one.value * scale, one.within * scale, one.where) if one is not None else None


def _check_unit(segment: Segment, k: int) -> None:
    """Raises FileError where the name of a channel states another unit than Y_Unit_Label."""
    label, where = segment.stated("Y_Unit_Label", k)
    inside = re.search(r"[(\[]([^()\[\]]+)[)\]]\s*$", segment.labels[k])
    one, other = unit_names.read(label), unit_names.read(inside[1] if inside else "")
    if one.unit and other.unit and (one.unit, one.scale) != (other.unit, other.scale):
        problem = f"Y_Unit_Label states {label!r} for the channel {segment.labels[k]!r}"
        raise FileError(Issue(where, problem, fix="correct the label or the name"))


def _clock(found: Channels, delta: Written | None, x: Array | None, single: bool) -> tuple[float | None, Array | None]:
    """Step (s), or time stamps with unequal steps; `single`: the stated step separates no two samples."""
    stated = delta.value if delta is not None and delta.value > 0 else None
    if x is None or len(x) < 2:
        return stated, x if x is not None and len(x) else None
    mean = float((x[-1] - x[0]) / (len(x) - 1))
    even = bool(np.max(np.abs(x - x[0] - mean * np.arange(len(x)))) <= 2 * _DIGIT + _EVEN * mean)
    if single or (stated is None and not even):
        return None, x
    if delta is not None and stated is not None:
        found.statements.append(step(delta, mean))
        if even and delta.within <= _DIGIT / (len(x) - 1):
            return stated, None
    return (mean, None) if even else (None, x)


def _written(segment: Segment, key: str, column: int, decimal: str) -> Written | None:
    text, where = segment.stated(key, column)
    if not text:
        return None
    try:
        return Written.of(text.replace(",", ".") if decimal == "," or "," in text else text, where)
    except ValueError:
        raise FileError(Issue(where, f"{key} is not a number", text, "correct the header")) from None


def _shares(segment: Segment, first: int, k: int) -> bool:
    """Whether the only column of X, which belongs to the `first` channel, is also that of channel k by start and step."""
    return all(segment.stated(key, k)[0] == segment.stated(key, first)[0] for key in ("X0", "Delta_X", "X_Unit_Label"))


def _holds(samples: float, count: int) -> bool:
    """Whether `count` rows are two or more packets of `samples`."""
    return samples >= 1 and count > samples and count % samples == 0


def _rate(delta: Written) -> str:
    """What to do about a rounded step: it can be that of one whole rate only, `0.000977` that of 1024 Hz."""
    first, last = np.ceil(1 / (delta.value + delta.within)), np.floor(1 / max(delta.value - delta.within, 1e-12))
    only = f"; the only whole rate that is written so is {first:g} Hz" if first == last else ""
    return f"give the rate where it is known{only}"


def _rises(x: Array) -> bool:
    return bool(np.all(np.diff(x) > 0))


def _comments(rows: list[Line], separator: str, last: int) -> list[str]:
    """A note on texts in the column of comments."""
    found = [
        (at, given[last]) for at, text in rows if text.count(separator) >= last and (given := fields(text, separator))[last]
    ]
    if separator == "," and (counted := next((at for at, text in found if number(text) is not None), 0)):
        fix = "correct the line; the decimal sign cannot be the separator"
        raise FileError(Issue(f"line {counted}", "has a number in the column of comments", fix=fix))
    more = f" and {len(found) - 1} more" if len(found) > 1 else ""
    return [f"line {found[0][0]} has the comment {found[0][1]!r}{more}"] if found else []
