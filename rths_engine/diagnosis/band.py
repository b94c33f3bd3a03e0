"""The band in which simulation and recording are compared."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.signal import firwin, upfirdn

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
ANALYSIS_RATE = 128.0  # Hz; compared signals lie below 0.4 of this rate
LENGTH = 20  # taps on each side for each decimated sample


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
        if self.factor == 1:
            return signal
        half = len(self.taps) // 2
        padded = np.concatenate([np.full(half, signal[0]), signal, np.full(half, signal[-1])])
        filtered: Array = upfirdn(self.taps, padded, 1, self.factor)
        first = 2 * half // self.factor
        return filtered[first : first + len(signal) // self.factor]
