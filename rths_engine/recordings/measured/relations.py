"""Relations between two signals: v = dx/dt except for a factor, and the power f v of a device."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
SAME = 1e-3  # of the range: rounding in the file
SMOOTHED = 9  # samples: smoothing removes the sampling noise of a derivative, not the motion of a test


class Relation(NamedTuple):
    """The relation b = factor * a and its correlation; both are zero where a or b is constant."""

    factor: float
    correlation: float


def of_derivative(x: Array, v: Array, dt: float) -> Relation:
    """The relation of v to dx/dt, both smoothed. Not valid for motion faster than a tenth of the sampling rate."""
    if len(x) < 4 * SMOOTHED:
        return Relation(0.0, 0.0)
    return between(uniform_filter1d(np.gradient(x, dt), SMOOTHED), uniform_filter1d(v, SMOOTHED))


def between(a: Array, b: Array) -> Relation:
    """The relation of b to a about their means, by least rectangles, which are least sensitive to noise on both."""
    a, b = a - a.mean(), b - b.mean()
    power = float(a @ a) * float(b @ b)
    if not (np.isfinite(power) and power > 0):
        return Relation(0.0, 0.0)
    correlation = float(a @ b) / np.sqrt(power)
    return Relation(float(np.sign(correlation) * np.sqrt((b @ b) / (a @ a))), float(correlation))


def limited(asked: Array, given: Array) -> bool:
    """Whether `given` equals `asked`, clipped at the extremes of `given` or not clipped."""
    if len(asked) != len(given) or not (np.isfinite(asked).all() and np.isfinite(given).all()) or np.ptp(given) == 0:
        return False
    low, high = float(given.min()), float(given.max())
    return bool(np.max(np.abs(np.clip(asked, low, high) - given)) < SAME * (high - low))


def dissipated(x: Array, force: Array) -> float:
    """Share of the exchanged energy that the device takes, -1 to 1: sum(f dx) / sum(|f dx|), f about its mean."""
    work = (force - force.mean())[:-1] * np.diff(x)
    exchanged = float(np.abs(work).sum())
    return float(work.sum()) / exchanged if exchanged > 0 else 0.0
