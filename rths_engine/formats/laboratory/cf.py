"""The conventions of NetCDF files: missing values, packing, and times that are counted from a date (CF Metadata Conventions).

value = scale_factor * stored + add_offset, missing where the stored value is `_FillValue` or `missing_value`, or outside the
valid range. Without `_FillValue`, the library's default of the type marks a value that was never written.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rths_engine.formats import stamps
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array

# by definition of NetCDF: the default fill values, and units of time in s
_FILL = 9.969209968386869e36
_FILLS = {"i2": -32767, "u2": 65535, "i4": -2147483647, "u4": 4294967295, "f4": _FILL, "f8": _FILL}
_SECONDS = {"days": 86400.0, "hours": 3600.0, "minutes": 60.0, "seconds": 1.0, "milliseconds": 1e-3, "microseconds": 1e-6}
_SPELLED = {"d": "days", "h": "hours", "hr": "hours", "min": "minutes", "s": "seconds", "sec": "seconds", "secs": "seconds"}
_SPELLED |= {"ms": "milliseconds", "msec": "milliseconds", "us": "microseconds"}
_SINCE = re.compile(r"\s*(\w+)\s+since\s+(.+)", re.IGNORECASE)


@dataclass(frozen=True)
class Variable:
    """A variable as it is stored, with its attributes and the names of its dimensions."""

    name: str
    stored: Any
    attributes: Mapping[str, Any]
    dimensions: Sequence[str]

    def text(self, name: str) -> str:
        value = self.attributes.get(name, "")
        return value.decode("utf-8", "replace") if isinstance(value, bytes) else value if isinstance(value, str) else ""

    def numbers(self, name: str) -> Array | None:
        value = self.attributes.get(name)
        found = np.ravel(np.asarray(value)) if value is not None and not isinstance(value, str | bytes) else np.zeros(0)
        return found.astype(float) if found.size and found.dtype.kind in "fiu" else None


def table(variables: Sequence[Variable], format: str, about: dict[str, str]) -> Table:
    """The numeric variables as columns, each on the clock of its own dimension."""
    notes: list[str] = []
    statements: list[Statement] = []
    unpacked = {one.name: _unpacked(one, notes, statements) for one in variables if np.asarray(one.stored).dtype.kind in "fiub"}
    notes += [f"{one.name} contains no numbers" for one in variables if one.name not in unpacked]
    clocks = _clocks([one for one in variables if one.name in unpacked], unpacked, about, notes)
    columns: list[Column] = []
    for dimension in dict.fromkeys(name for one in variables for name in one.dimensions):
        clock = clocks.get(dimension)
        found: list[Column] = []
        for one in variables:
            if one.name in unpacked and _leading(one, clocks) == dimension and (clock is None or one.name != clock.name):
                found += _columns(one, *unpacked[one.name], dimension)
        columns += found if clock is None or len(clock.values) < 2 else stamps.timed(found, clock) if found else [clock]
    return Table(format, distinct(columns), notes=tuple(notes), statements=tuple(statements), about=about)


def _clocks(
    variables: Sequence[Variable], unpacked: Mapping[str, tuple[Array, str]], about: dict[str, str], notes: list[str]
) -> dict[str, Column]:
    """The time (s) of each dimension that has one. Times since a date begin at the first time since this date."""
    clocks: dict[str, Column] = {}
    dates: dict[str, str] = {}
    for one in variables:
        factor, since = _time(one)
        if factor and len(one.dimensions) == 1 and one.dimensions[0] not in clocks and len(unpacked[one.name][0]):
            clocks[one.dimensions[0]] = Column(one.name, unpacked[one.name][0] * factor, "s", quantity="time")
            if since:
                dates[one.dimensions[0]] = since
                about[f"{one.name} since"] = since
    if len(set(dates.values())) > 1:
        notes.append(f"times count from different dates: {', '.join(sorted(set(dates.values())))}; each begins at 0")
    firsts: dict[str, float] = {}
    for name, since in dates.items():
        firsts[since] = min(firsts.get(since, np.inf), float(clocks[name].values[0]))
    return {name: replace(one, values=one.values - firsts.get(dates.get(name, ""), 0.0)) for name, one in clocks.items()}


def _leading(one: Variable, clocks: Mapping[str, Column]) -> str:
    """The dimension along which the samples stand: one with times, else the longest."""
    if not one.dimensions:
        return ""
    timed = next((name for name in one.dimensions if name in clocks), None)
    return timed or one.dimensions[int(np.argmax(np.shape(one.stored)))]


def _columns(one: Variable, values: Array, applied: str, dimension: str) -> list[Column]:
    axis = list(one.dimensions).index(dimension)
    rows = np.moveaxis(values, axis, 0).reshape(values.shape[axis], -1)
    if rows.shape[1] == 1:
        return [Column(one.name, rows[:, 0].copy(), one.text("units"), applied=applied)] if len(rows) > 1 else []
    names = [f"{one.name}.{k}" for k in range(1, rows.shape[1] + 1)]
    found = [Column(name, rows[:, k].copy(), one.text("units")) for k, name in enumerate(names)] if len(rows) > 1 else []
    return [replace(column, applied=applied) for column in found]


def _unpacked(one: Variable, notes: list[str], statements: list[Statement]) -> tuple[Array, str]:
    """The values, with NaN for missing ones, and what was applied."""
    stored = _signed(one, np.asarray(one.stored))
    values = stored.astype(float)
    missing = np.zeros(values.shape, bool)
    for name in ("_FillValue", "missing_value"):
        if (marks := _bounds(one, name)) is not None:
            missing |= np.isin(values, marks)
    if one.numbers("_FillValue") is None and (fill := _FILLS.get(stored.dtype.str[1:])) is not None:
        missing |= stored == np.asarray(fill, dtype=stored.dtype)
    limits = _bounds(one, "valid_range")
    lows, highs = (limits[:1], limits[1:2]) if limits is not None and len(limits) == 2 else (None, None)
    if (least := _bounds(one, "valid_min") if lows is None else lows) is not None:
        missing |= values < least[0]
    if (most := _bounds(one, "valid_max") if highs is None else highs) is not None:
        missing |= values > most[0]
    factor, offset = one.numbers("scale_factor"), one.numbers("add_offset")
    words = []
    if factor is not None and factor[0] != 1:
        values = values * factor[0]
        words.append(f"x {factor[0]:g} (scale_factor)")
    if offset is not None and offset[0] != 0:
        values = values + offset[0]
        words.append(f"+ {offset[0]:g} (add_offset)")
    if missing.any():
        values = np.where(missing, np.nan, values)
        notes.append(f"{one.name}: {int(missing.sum())} of {missing.size} samples are missing by its attributes")
    actual = one.numbers("actual_range")
    if actual is not None and len(actual) == 2 and np.isfinite(values).any():
        within = 1e-6 * float(np.nanmax(np.abs(values)))
        for what, stated, read in (("smallest", actual[0], np.nanmin(values)), ("largest", actual[1], np.nanmax(values))):
            unit = one.text("units")
            statements.append(
                Statement(f"{what} value of {one.name}", "actual_range", float(stated), float(read), unit, within)
            )
    return values, f"stored value {' '.join(words)}" if words else ""


def _bounds(one: Variable, name: str) -> Array | None:
    """Stored values in an attribute, with or without sign as the variable."""
    found, kind = one.numbers(name), np.asarray(one.stored).dtype
    if found is None or kind.kind == "f" or not np.isfinite(found).all():
        return found
    return np.asarray(_signed(one, found.astype(kind)), dtype=float)


def _signed(one: Variable, stored: Any) -> Any:
    """The whole numbers with or without sign as `_Unsigned` says, because NetCDF 3 has no type without sign."""
    kind = {"true": "u", "false": "i"}.get(one.text("_Unsigned").lower())
    if kind is None or stored.dtype.kind not in "iu" or stored.dtype.kind == kind:
        return stored
    return np.ascontiguousarray(stored).view(stored.dtype.str.replace(stored.dtype.kind, kind, 1))


def _time(one: Variable) -> tuple[float, str]:
    """Seconds in the unit of a variable that is a time coordinate, and the date that it counts from; 0 where it is none."""
    units = one.text("units")
    since = _SINCE.fullmatch(units)
    word = (since[1] if since else units).strip().lower()
    word = _SPELLED.get(word, word if word.endswith("s") else f"{word}s")
    coordinate = list(one.dimensions) == [one.name] or one.text("standard_name") == "time" or one.text("axis") == "T"
    return (_SECONDS.get(word, 0.0), since[2] if since else "") if since or coordinate else (0.0, "")
