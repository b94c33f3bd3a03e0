"""Tables whose rows are signals: the first row all times, the second all values, as MATLAB writes `[t; a]`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.formats.plain import headings
from rths_engine.formats.plain.form import COMMENT, Form, Line
from rths_engine.formats.plain.refusals import not_a_number, other_width
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
FEWEST = 50  # samples of a signal in a row
_LONGER = 4  # times as many samples as signals
MOST_LINES = 400
_EVEN = 0.1  # of a step: time stamps have few digits


@dataclass(frozen=True, eq=False)
class Signal:
    """A row: its name (empty: none), its unit as written, its values and its line."""

    name: str
    unit: str
    values: Array
    line: int


def read(lines: Sequence[Line]) -> tuple[list[Line], list[Signal]] | None:
    """The header and the signals of a text whose rows are signals; None where its rows are samples.

    The first row must increase by equal steps, or every row begin with a name. Raises FileError for a row that differs.
    """
    filled = [(at, text.strip()) for at, text in lines if text.strip()]
    if len(filled) > MOST_LINES:
        return None
    for separator, decimal in ((";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), ("", "."), ("", ",")):
        form = Form(separator, decimal)
        start = next((k for k, (_, text) in enumerate(filled) if _long(text, form)), None)
        if start is None:
            continue
        rows = filled[start:]
        if not 2 <= len(rows) <= MOST_LINES or not all(_long(text, form) for _, text in rows):
            continue
        signals = [_signal(line, form) for line in rows]
        count = len(signals[0].values)
        if count < _LONGER * len(signals) or not (all(one.name for one in signals) or even(signals[0].values)):
            continue
        for one, (at, text) in zip(signals, rows, strict=True):
            if len(one.values) != count:
                raise other_width(at, text[:40], len(one.values), count, "numbers")
        return filled[:start], signals
    return None


def even(times: Array) -> bool:
    """Whether the values increase by nearly equal steps."""
    steps = np.diff(times)
    if len(steps) < 2 or not np.isfinite(steps).all():
        return False
    step = float(np.mean(steps))
    return step > 0 and bool(np.all(np.abs(times - times[0] - step * np.arange(len(times))) <= _EVEN * step))


def _long(text: str, form: Form) -> bool:
    if COMMENT.match(text):
        return False
    fields = _fields(text, form)
    return len(fields) >= FEWEST and sum(form.number(field) is not None for field in fields[-FEWEST:]) > FEWEST / 2


def _fields(text: str, form: Form) -> list[str]:
    fields = form.fields(text)
    return fields[:-1] if form.separator and not fields[-1] else fields


def _signal(line: Line, form: Form) -> Signal:
    at, text = line
    fields = _fields(text, form)
    first = next(k for k, field in enumerate(fields) if k and form.number(fields[k]) is not None)
    if form.number(fields[0]) is not None:
        first = 0
    values = [form.number(field) for field in fields[first:]]
    for field, number in zip(fields[first:], values, strict=True):
        if number is None:
            raise not_a_number(at, field)
    label = fields[:first]
    unit = label[1].strip("()[] ") if form.separator and len(label) == 2 else ""
    name = (label[0] if unit else " ".join(label)).rstrip(":= ")
    return Signal(name, unit or headings.name_and_unit(name)[1], np.array(values, dtype=float), at)
