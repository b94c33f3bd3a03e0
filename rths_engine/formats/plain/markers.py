"""Values that mark missing samples: -999, 1e30 and the like, stated in the header or standing out of the data."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from rths_engine.formats.statement import Written
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
BEYOND = 20.0  # times the largest other value


MARKERS = frozenset((*_DIGITS, *_POWERS))


def refuse(values: Array, name: str, line: Callable[[int], int], stated: Sequence[Written] = ()) -> None:
    """Raises FileError where a value is the stated marker, or is a usual marker and stands out. `line`: that of a sample."""
    for marker in stated:
        if len(at := np.flatnonzero(values == marker.value)):
            raise _refusal(values, at, name, line, f"which {marker.where} states to mark missing values")
    if not len(values) or max(abs(float(np.fmax.reduce(values))), abs(float(np.fmin.reduce(values)))) not in MARKERS:
        return  # without a copy of the column
    size = np.abs(values[np.isfinite(values)])
    found: list[float] = []
    while len(size) and (largest := float(np.max(size))) in MARKERS:
        found.append(largest)
        size = size[size < largest]
    others = float(np.max(size, initial=0.0))
    for marker_size in found:
        if len(size) and marker_size > BEYOND * others:
            at = np.flatnonzero(np.abs(values) == marker_size)
            raise _refusal(values, at, name, line, f"a usual mark of missing values; no other is beyond {others:g}")


def refuse_infinite(values: Array, name: str, line: Callable[[int], int]) -> None:
    """Raises FileError for an infinite value."""
    if len(at := np.flatnonzero(np.isinf(values))):
        problem = f"{name} is infinite"
        fix = "leave the field empty where the value is missing, or leave the column out"
        raise FileError(Issue(f"line {line(int(at[0]))}", problem, f"{values[at[0]]:g}", fix))


def _refusal(values: Array, at: np.ndarray, name: str, line: Callable[[int], int], why: str) -> FileError:
    times = "" if len(at) == 1 else f" ({len(at)} times)"
    problem = f"{name} is {values[int(at[0])]:g}{times}, {why}"
    fix = "replace the missing values by measured ones, or leave the column out"
    return FileError(Issue(f"line {line(int(at[0]))}", problem, fix=fix))
