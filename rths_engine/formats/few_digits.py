"""Times in few digits: t_k = start + k step, rounded to six significant digits, as recorders of OpenSees and `%g` write them.

From 100 s on six digits resolve 1 ms, from 1000 s on 10 ms: stamps of a short step are then uneven, or equal to each other.

Each stamp bounds start + k step to half a unit of its last digit on both sides. The steps that meet all bounds are an interval.
Each end of it is approached from outside, from the two stamps that contradict each other most (a linear programme of two
unknowns). The step is that of least squares, moved into the interval: bounds are wide where it is a multiple of the last digit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array

# by definition
DIGITS = 6  # of `%g` and of the streams of C++
_HALF = 0.5  # of a unit of the last digit: what rounding changes

# chosen; see docs/decisions/0023
_FEWEST_UNITS = 100.0  # of the last digit, by which the stamps rise in total; less can be noise of a constant
_SPARE = 1e-12  # of the largest value: arithmetic
_MOST = 100  # approaches to the end of the interval
_FINEST = 1e-6  # of the largest unit: finer stamps count no more in the fit


def last_digit(values: Array) -> Array:
    """The unit of the sixth significant digit of each value; of a zero, that of the smallest other value."""
    size = np.abs(values)
    other = size > _SPARE * size.max()
    size = np.where(other, size, size[other].min() if other.any() else 1.0)
    return np.asarray(10.0 ** (np.floor(np.log10(size) + _SPARE) - (DIGITS - 1)))


class EqualSteps(NamedTuple):
    """The step of stamps by least squares, and the smallest and the largest that their digits allow."""

    step: float
    smallest: float
    largest: float


def equal_steps(times: Array) -> EqualSteps | None:
    """The step of times that are equal steps except for their six digits; None for all others."""
    count = len(times)
    if count < 3 or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        return None
    unit = last_digit(times)
    digits = times / unit
    if np.sum(np.diff(times) / unit[1:]) < _FEWEST_UNITS or not np.allclose(digits, np.rint(digits), rtol=0, atol=1e-3):
        return None
    low, high = _bounds(times)
    smallest, largest = _end(low, high, 0.0), _end(low, high, float(np.diff(times).max() + 2 * (high - low).max()))
    if smallest is None or largest is None:
        return None
    fitted = np.polyfit(np.arange(count, dtype=float), times, 1, w=1 / np.maximum(unit / unit.max(), _FINEST))[0]
    return EqualSteps(min(max(float(fitted), smallest), largest), smallest, largest)


def start(times: Array, step: float) -> float:
    """The start in the middle of the bounds of all stamps, with a step that `equal_steps` allows."""
    passed = np.arange(len(times)) * step
    low, high = _bounds(times)
    return 0.5 * float((low - passed).max() + (high - passed).min())


def _bounds(times: Array) -> tuple[Array, Array]:
    half = _HALF * last_digit(times) + _SPARE * float(np.abs(times).max())
    return times - half, times + half


def _end(low: Array, high: Array, step: float) -> float | None:
    """The step nearest to `step` with which start + k step lies between `low` and `high` for one start, if there is one."""
    index, upward = np.arange(len(low), dtype=float), step == 0.0
    for _ in range(_MOST):
        passed = index * step
        first, second = int(np.argmax(low - passed)), int(np.argmin(high - passed))
        lacks = float(low[first] - high[second]) - (first - second) * step
        if lacks <= 0:
            return step
        if first == second or (first > second) != upward:
            return None
        step += lacks / (first - second)
    return None
