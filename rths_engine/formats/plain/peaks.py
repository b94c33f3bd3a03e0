"""The peaks that a header states, each beside the largest value of its column."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np

from rths_engine.formats import statement
from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.header_facts import Facts, in_unit
from rths_engine.formats.plain.header_lines import Peak
from rths_engine.formats.plain.headings import name_and_unit, quantity_of
from rths_engine.formats.statement import Statement, Written
from rths_engine.formats.table import Column
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array

_SIDES = (
    {"ud", "v", "z", "up", "vertical", "vert", "vertikal", "verticale"},
    {"ns", "n", "nordsud", "northsouth", "nortesur", "sn"},
    {"ew", "e", "ow", "eo", "ostwest", "eastwest", "estouest", "esteoeste", "we"},
)
_MOST_DIGITS = 8  # decimals by which values are rounded; chosen, see docs/decisions/0023


def statements(columns: Sequence[Column], facts: Facts) -> list[Statement]:
    """Each peak in the header beside that of the column that it names, or of the nearest column where it names none."""
    found: list[Statement] = []
    for peak in facts.peaks:
        options = [of for column in _meant(peak, columns) if (of := _beside(peak, column, len(columns) > 1))]
        if options:
            nearest = min(options, key=lambda pair: abs(pair[0].stated - pair[0].read))
            found += nearest
    return found


def confirmed_unit(signals: Iterable[Array], facts: Facts) -> unit_names.Written:
    """The unit of the stated peaks, where they have one unit and the largest of them equals that of a signal; else no unit."""
    stated = {one.unit: one for one in sorted(facts.peaks, key=lambda one: abs(one.value.value)) if one.unit and not one.least}
    if len(stated) != 1:
        return unit_names.read("")
    ((unit, peak),) = stated.items()
    sizes = [(float(np.nanmax(np.abs(values), initial=0.0)), _rounding(values)) for values in signals]
    agrees = any(abs(abs(peak.value.value) - size) <= peak.value.within + rounding for size, rounding in sizes)
    return unit_names.read(unit if agrees else "")


def same_component(one: str, other: str) -> bool:
    """Whether two texts name one component: `N-S` and `ns`, `U-D` and `Vertical`."""
    left, right = (re.sub(r"[^a-z0-9]", "", words.plain(text)) for text in (one, other))
    return bool(left) and (left == right or any(left in side and right in side for side in _SIDES))


def _meant(peak: Peak, columns: Sequence[Column]) -> list[Column]:
    signals = [one for one in columns if one.quantity != "time"]
    if peak.component:
        return [one for one in signals if _names(one.name, peak.component)]
    if peak.quantity:
        signals = [one for one in signals if (one.quantity or quantity_of(*_named(one)) or peak.quantity) == peak.quantity]
    return signals


def _names(name: str, component: str) -> bool:
    plain = name_and_unit(name)[0]
    parts = re.findall(r"[^\W_]+(?:\s*-\s*[^\W_]+)?", plain)
    return any(same_component(part, component) for part in (*parts, *re.findall(r"[^\W_]+", plain), plain))


def _named(column: Column) -> tuple[str, str]:
    name, unit = name_and_unit(column.name)
    return name, column.unit or unit


def _beside(peak: Peak, column: Column, several: bool) -> list[Statement]:
    """The peak and its time beside the column; empty where their units cannot be compared."""
    written = unit_names.read(_named(column)[1])
    if written.problem or (peak.unit and not written.none and not written.plain):
        return []
    stated = in_unit(peak, written.unit)
    values = column.values[np.isfinite(column.values)]
    if stated is None or not len(values) or (written.none and _in_some_unit(peak, values)):
        return []
    found: list[Statement] = []
    of = column.name if several else ""
    if np.isfinite(stated.value):
        if peak.least:
            return [_lowest(stated, values, written.unit, of)]
        one = statement.peak(stated, values, written.unit, _rounding(values), of)
        largest = float(np.max(values))
        found.append(
            one
            if one.agrees or abs(stated.value - largest) > one.within
            else statement.peak(stated, np.array([largest]), written.unit, 0.0, of)
        )
    if peak.time is not None and column.dt is not None and len(values) == len(column.values):
        found.append(statement.peak_time(peak.time, values, column.dt, column.start, of))
    return found


def _lowest(stated: Written, values: Array, unit: str, of: str) -> Statement:
    """The smallest value; a value stated without its sign can be its size."""
    read = float(np.min(values))
    if stated.value > 0 > read and abs(stated.value + read) < abs(stated.value - read):
        read = -read
    within = stated.within + _rounding(values) + 1e-6 * abs(read)
    return Statement(f"minimum{of and f' of {of}'}", stated.where, stated.value, read, unit, within)


def _in_some_unit(peak: Peak, values: Array) -> bool:
    """Whether the peak equals that of the values in another unit of its dimension, which the file does not state for them."""
    written = unit_names.read(peak.unit)
    if not written.unit:
        return written.problem != ""
    size, rounding = abs(float(np.min(values) if peak.least else np.max(np.abs(values)))), _rounding(values)
    others = [in_unit(peak, unit) for unit in units.of_dimension(written.dimension)]
    return any(one is not None and abs(abs(one.value) - size) <= one.within + rounding for one in others)


def _rounding(values: Array) -> float:
    """Half a unit of the last decimal to which the values are written."""
    few = values[:1000]
    for digits in range(_MOST_DIGITS):
        if np.all(np.abs(few - np.round(few, digits)) <= 1e-12 * np.abs(few)):
            return float(0.5 * 10.0**-digits)
    return 0.0
