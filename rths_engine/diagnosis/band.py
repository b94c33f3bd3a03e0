"""The band in which simulation and recording are compared."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.signal import firwin

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
ANALYSIS_RATE = 128.0  # Hz; compared signals lie below 0.4 of this rate
LENGTH = 20  # taps on each side for each decimated sample
PIECE = 16384  # decimated samples that are filtered at once: their products stay in the cache


@dataclass(frozen=True, slots=True)
class Band:
    """Decimation of signals with the step `dt` to every `factor`-th sample by a zero-phase low-pass filter."""

    dt: float
    factor: int
    taps: Array

    @classmethod
    @lru_cache(maxsize=16)
    def of(cls, dt: float) -> Band:
        factor = max(1, int(1 / (dt * ANALYSIS_RATE)))
        taps = firwin(2 * LENGTH * factor + 1, 0.8 / factor) if factor > 1 else np.ones(1)
        return cls(dt, factor, taps)

    @property
    def step(self) -> float:
        return self.dt * self.factor

    def reduced(self, signal: Array) -> Array:
        """The filtered signal at every `factor`-th sample.

        Blocks of `factor` samples are multiplied with all parts of the filter at once, and each decimated sample is the sum of
        the products of 2 LENGTH + 1 successive blocks.
        """
        if self.factor == 1:
            return signal
        half, count = LENGTH * self.factor, len(signal) // self.factor
        padded = np.concatenate([np.full(half, signal[0]), signal, np.full(half, signal[-1])])
        blocks = padded[: (count + 2 * LENGTH) * self.factor].reshape(-1, self.factor)
        taps = self.taps[:-1].reshape(2 * LENGTH, self.factor)  # symmetric: a convolution is a correlation
        found: Array = self.taps[-1] * padded[2 * half :: self.factor][:count]
        for start in range(0, count, PIECE):
            piece = found[start : start + PIECE]
            for place, row in enumerate(taps @ blocks[start : start + len(piece) + 2 * LENGTH].T):
                piece += row[place : place + len(piece)]
        return found
