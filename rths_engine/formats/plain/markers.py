"""Values that mark missing samples: -999, 1e30, 32767 and the like, stated in the header or standing out of the data."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rths_engine.formats.scratch import on_disk
from rths_engine.formats.statement import Written
from rths_engine.formats.table import Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_DIGITS = (
    99.0, 99.9, 99.99, 99.999, 999.0, 999.9, 999.25, 999.99, 999.999, 9999.0, 9999.9, 9999.99, 99999.0, 99999.9, 99999.99,
    999999.0, 9999999.0, 99999999.0, 999999999.0, 9999999999.0, 6999.0, 7777.0, 8888.0,
)  # fmt: skip
_POWERS = (
    1e10, 1e20, 1e30, 9.99e30, 1e31, 1e32, 1e33, 1e34, 1e35, 1e36, 1e37, 1e38, 3.4e38,
    3.40282e38, 3.4028235e38, 1e99, 1e100, 1e300,
)  # fmt: skip
_OVERFLOWS = (32767.0, 32768.0, 65535.0, 8388607.0, 8388608.0, 2147483647.0, 2147483648.0, 4294967295.0)  # of a converter
BEYOND = 20.0  # times the largest other value
_LONG = 999.0  # markers with three digits or more
_LONG_BEYOND, _REPEATED_BEYOND = 4.0, 2.0  # in place of BEYOND for these; for one of them that comes several times
_JUMP = 8.0  # times the largest step beside it, on both sides
_BESIDE = 50  # samples
_STATES = 2  # of a switch
_BLOCK = 1 << 16  # samples looked at in one go
_CODES = 10  # a column of fewer values is one of codes, such as a status, in which 99 can be a code


MARKERS = frozenset((*_DIGITS, *_POWERS))
_ALONE = np.array(sorted({*MARKERS, *_OVERFLOWS}))


def refuse(values: Array, name: str, line: Callable[[int], int], stated: Sequence[Written] = ()) -> None:
    """Raises FileError where a value is the stated marker, or is a usual marker and stands out. `line`: that of a sample."""
    for marker in stated:
        if len(at := np.flatnonzero(values == marker.value)):
            raise _refusal(values, at, name, line, f"which {marker.where} states to mark missing values")
    largest = max(abs(float(np.fmax.reduce(values))), abs(float(np.fmin.reduce(values)))) if len(values) else 0.0
    if largest in MARKERS:
        _refuse_largest(values, name, line)
    if largest >= _ALONE[0] and (first := _alone(values)) is not None:
        at = np.flatnonzero(values == values[first])
        beside = ", ".join(f"{values[k]:g}" for k in (_other(values, first, -1), _other(values, first, 1)) if k is not None)
        raise _refusal(values, at, name, line, f"a usual mark of missing values; beside it stands {beside}")


def _refuse_largest(values: Array, name: str, line: Callable[[int], int]) -> None:
    """Raises FileError where the largest values are a usual marker, far beyond the others."""
    size = np.abs(values[np.isfinite(values)])
    found: list[float] = []
    while len(size) and (largest := float(np.max(size))) in MARKERS:
        found.append(largest)
        size = size[size < largest]
    others = float(np.max(size, initial=0.0))
    for marker_size in found:
        at = np.flatnonzero(np.abs(values) == marker_size)
        least = BEYOND if marker_size < _LONG else _REPEATED_BEYOND if _equal(values[at]) else _LONG_BEYOND
        if len(size) and marker_size > least * others:
            raise _refusal(values, at, name, line, f"a usual mark of missing values; no other is beyond {others:g}")


def _equal(values: Array) -> bool:
    return len(values) > 1 and bool((values == values[0]).all())


def _alone(values: Array) -> int | None:
    """The first sample with the value of a marker to which the signal jumps, and from which it jumps back."""
    for start in range(0, len(values), _BLOCK):
        part = values[max(0, start - 1) : start + _BLOCK + 1]
        steps = np.abs(np.diff(part))
        far = np.flatnonzero(steps > 2 * np.nanmean(steps)) if len(part) > _BLOCK // 16 else np.arange(len(steps))
        near = np.unique(np.concatenate([far, far + 1]))
        for k in near[np.isin(np.abs(part[near]), _ALONE)]:
            at = int(k) + max(0, start - 1)
            if _jumps(values, at):
                return at
    return None


def _jumps(values: Array, at: int) -> bool:
    """Whether the values on both sides of a run of one value are far from it, by the steps of their own neighbours."""
    marker = values[at]
    before, after = _other(values, at, -1), _other(values, at, 1)
    sides = [float(values[k]) - float(marker) for k in (before, after) if k is not None]
    if not sides or len({np.sign(one) for one in sides}) > 1:
        return False
    beside = values[max(0, at - _BESIDE) : at + _BESIDE]
    others = beside[beside != marker]
    others = others[np.isfinite(others)]
    step = float(np.max(np.abs(np.diff(others)), initial=0.0))
    if step == 0.0 and len(np.unique(values[:_BLOCK])) <= _STATES:
        return False
    return len(others) > 1 and min(map(abs, sides)) > _JUMP * step


def _other(values: Array, at: int, way: int) -> int | None:
    """The nearest finite sample with another value, backward (-1) or forward; None where there is none within a block."""
    part = values[at : at + _BLOCK] if way > 0 else values[max(0, at - _BLOCK) : at + 1][::-1]
    found = np.flatnonzero((part != values[at]) & np.isfinite(part))
    return at + way * int(found[0]) if len(found) else None


def refuse_in(table: Table) -> None:
    """Raises FileError where a sample is a usual marker that stands out, in a file of any format; it names the sample."""
    issues: list[Issue] = []
    for column in table.columns:
        if on_disk(column.values) or not len(column.values):
            continue  # of a text, whose reader has named the line
        try:
            refuse(column.values, column.name, lambda at: at + 1)
        except FileError as refusal:
            if len(np.unique(column.values)) >= _CODES:
                issues += [replace(one, where=one.where.replace("line", "sample", 1)) for one in refusal.issues]
    if issues:
        raise FileError(issues)


def _refusal(values: Array, at: np.ndarray, name: str, line: Callable[[int], int], why: str) -> FileError:
    times = "" if len(at) == 1 else f" ({len(at)} times)"
    problem = f"{name} is {values[int(at[0])]:g}{times}, {why}"
    fix = "replace the missing values by measured ones, or leave the column out"
    return FileError(Issue(f"line {line(int(at[0]))}", problem, fix=fix))
