"""Gains that a header states for a column in volts or counts: `Force gain: 2.5 kN/V`, `Load: scale factor 0.001 kN/count`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.headings import name_and_unit
from rths_engine.formats.scratch import on_disk
from rths_engine.formats.table import Column
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.unit_names import Written

_RAW = {"voltage", "count"}
_UNIT = r"[a-z%\u00b5\u03bc][a-z0-9^*.]*(?:/s(?:ec)?(?:\^?2|/s(?:ec)?)?)?"
_GAIN = re.compile(
    rf"(?P<v>{words.NUMBER})\s*\(?(?P<top>{_UNIT})\)?\s*(?:/|\bper\s)\s*\(?(?P<below>{_UNIT})\)?(?=[\s,;)]|$)", re.IGNORECASE
)
_NOT_ALONE = re.compile(r"offset|zero|bias|excitation|null|\brange\b|full\s*scale")


@dataclass(frozen=True, slots=True)
class _Gain:
    """One `raw` is `scale` of `unit`, as the line `at` states it."""

    at: int
    text: str
    stated: str
    unit: Written
    raw: Written
    scale: float


def applied(columns: Sequence[Column], header: Sequence[Line]) -> list[Column]:
    """The columns; the gain of the one line that names a column in volts or counts is applied, where no line states an offset.

    The columns of a file too large for memory stay as they are: their gain is asked for.
    """
    if any(_NOT_ALONE.search(words.plain(text)) for _, text in header):
        return list(columns)
    gains = [gain for line in header if (gain := _gain(line)) is not None]
    found = list(columns)
    for k, column in enumerate(columns):
        own = unit_names.read(column.unit)
        fitting = [one for one in gains if own.dimension == one.raw.dimension and _names(column.name, one.text)]
        meant = [other for one in fitting for other in columns if _fits(other, one)]
        if len(fitting) != 1 or len(meant) != 1 or on_disk(column.values):
            continue
        gain = fitting[0]
        factor = gain.scale * own.scale * units.factor(own.unit) / units.factor(gain.raw.unit)
        said = f"values x {factor:g} {gain.unit.unit} (line {gain.at}: {gain.stated})"
        name = name_and_unit(column.name)[0]
        found[k] = replace(column, name=name, values=column.values * factor, unit=gain.unit.unit, applied=said)
    return found


def _gain(line: Line) -> _Gain | None:
    at, typed = line
    text = words.without_accents(typed)
    matches = list(_GAIN.finditer(text))
    if len(matches) != 1:
        return None
    match = matches[0]
    top, below, value = unit_names.read(match["top"]), unit_names.read(match["below"]), words.number(match["v"].lower())
    if value <= 0 or not (top.plain and below.plain) or (top.dimension in _RAW) == (below.dimension in _RAW):
        return None
    label = words.plain(text[: match.start()])
    if below.dimension in _RAW:
        return _Gain(at, label, match[0].strip(), top, below, value)
    return _Gain(at, label, match[0].strip(), below, top, 1 / value)


def _fits(column: Column, gain: _Gain) -> bool:
    return unit_names.read(column.unit).dimension == gain.raw.dimension and _names(column.name, gain.text)


def _names(name: str, label: str) -> bool:
    """Whether the label of a gain contains the name of a column, word for word."""
    plain = re.findall(r"[^\W_]+", words.plain(name_and_unit(name)[0]))
    return bool(plain) and set(plain) <= set(re.findall(r"[^\W_]+", label)) and any(len(word) > 1 for word in plain)
