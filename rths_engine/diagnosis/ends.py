"""The ends of a recording, where the filters blur the signals and a simulation may not be in its state."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
ENDS = 0.3  # s


def inner(count: int, step: float) -> NDArray[np.bool_]:
    """Mask of the samples that are at least ENDS away from both ends."""
    place = np.arange(count) * step
    found: NDArray[np.bool_] = (place >= ENDS) & (place < count * step - ENDS)
    return found


def mirrored(signals: Array, used: NDArray[np.bool_]) -> Array:
    """Signals (channels, n) whose samples before the first and after the last `used` one are those beside them, mirrored.

    A whitener carries what stands in the ends into the samples after them: the jump of a simulation that starts in another
    state than the specimen was 4000 times the noise.
    """
    inside = np.flatnonzero(used)
    if not len(inside) or len(inside) == signals.shape[1]:
        return signals
    first, last = int(inside[0]), int(inside[-1])
    place = np.arange(signals.shape[1])
    place = np.clip(np.where(place < first, 2 * first - place, np.where(place > last, 2 * last - place, place)), first, last)
    return signals[:, place]
