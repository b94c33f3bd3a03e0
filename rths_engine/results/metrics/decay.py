"""Free decay x(t) = X exp(-zeta omega t) cos(omega_d t + phi): the slope of ln X_k over the cycles k is -delta, the decrement.

zeta = delta / sqrt(4 pi^2 + delta^2). A cycle lies between two upward crossings of zero, and X_k is its
largest value. The first cycle is not used, because higher modes still vibrate in it. Source: Chopra, Dynamics of Structures,
section 2.2. Where yielding or friction make frequency or damping depend on the amplitude, the result is only an average.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
LEAST_CYCLES = 3
SMALLEST = 0.01  # of the first cycle used; smaller cycles are near the rounding or the noise of a record


class Decay(NamedTuple):
    """Period between crossings (s), damping ratio (number), cycles used."""

    period: float
    ratio: float
    cycles: int


def free_decay(x: Array, dt: float) -> Decay | None:
    """The free decay of a displacement about zero, every `dt` (s); None for less than LEAST_CYCLES cycles."""
    up = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    crossings = (up + x[up] / (x[up] - x[up + 1])) * dt
    peaks = np.array([x[first:last].max() for first, last in pairwise(up[1:])])
    peaks = peaks[: int(np.argmax(np.append(peaks < SMALLEST * peaks[:1], True)))]
    if len(peaks) < LEAST_CYCLES:
        return None
    cycles = np.arange(len(peaks))
    delta = -float(np.polyfit(cycles, np.log(peaks), 1)[0])
    period = float(crossings[1 + len(peaks)] - crossings[1]) / len(peaks)
    return Decay(period, delta / float(np.hypot(2 * np.pi, delta)), len(peaks))
