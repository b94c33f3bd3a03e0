"""What ties two signals together: v = dx/dt up to a factor, and the power f v of a device."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
SAME = 1e-3  # of the range: rounding in the file
SMOOTHED = 9  # samples: takes the sampling noise off a derivative, not the motion of a test


class Relation(NamedTuple):
    """b = factor * a with this correlation; zero where either does not move."""

    factor: float
    correlation: float


def of_derivative(x: Array, v: Array, dt: float) -> Relation:
    """How v stands to dx/dt, both smoothed. Fails first for motion faster than a tenth of the sampling rate."""
    if len(x) < 4 * SMOOTHED:
        return Relation(0.0, 0.0)
    return between(uniform_filter1d(np.gradient(x, dt), SMOOTHED), uniform_filter1d(v, SMOOTHED))


def between(a: Array, b: Array) -> Relation:
    """How b stands to a about their means: by least rectangles, which noise on either bends least."""
    a, b = a - a.mean(), b - b.mean()
    power = float(a @ a) * float(b @ b)
    if not (np.isfinite(power) and power > 0):
        return Relation(0.0, 0.0)
    correlation = float(a @ b) / np.sqrt(power)
    return Relation(float(np.sign(correlation) * np.sqrt((b @ b) / (a @ a))), float(correlation))


def limited(asked: Array, given: Array) -> bool:
    """Whether `given` is `asked` cut off at the extremes of `given`, or all of it."""
    if len(asked) != len(given) or not (np.isfinite(asked).all() and np.isfinite(given).all()) or np.ptp(given) == 0:
        return False
    low, high = float(given.min()), float(given.max())
    return bool(np.max(np.abs(np.clip(asked, low, high) - given)) < SAME * (high - low))


def dissipated(x: Array, force: Array) -> float:
    """Share of the exchanged energy that the device takes, -1 to 1: sum(f dx) / sum(|f dx|), f about its mean."""
    work = (force - force.mean())[:-1] * np.diff(x)
    exchanged = float(np.abs(work).sum())
    return float(work.sum()) / exchanged if exchanged > 0 else 0.0
