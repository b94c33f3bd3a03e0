"""Delay = the lag k dt where r[k] = sum d_c[i] d_m[i+k] / sqrt(sum d_c[i]^2 sum d_m[i+k]^2) is largest, s; positive: lag.

`x_cmd` and `x_meas` (samples), every `dt` (s). Each sum runs over the samples that form pairs at lag k. Between samples, the
lag is the vertex of the parabola through the largest r and its neighbours, exact to O(dt^2) for a smooth record. Common in
hybrid simulation: Riascos, Ou and Dyke, Hybrid Simulation Current Assessment Measures (2014).

The delay is None where nothing moved, or where the largest r is at an end of the searched lags (LONGEST_S, at most a quarter of
the record). Where one frequency dominates and LONGEST_S exceeds half of its period, the
delay is ambiguous: a lag longer by one cycle fits equally well.
"""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
LONGEST_S = 0.2


def correlation_delay(x_cmd: Array, x_meas: Array, dt: float) -> float | None:
    """The delay of the whole record."""
    running = RunningCorrelation(dt)
    running.take(x_cmd, x_meas)
    return running.value()


class RunningCorrelation:
    """The sums of every lag, for a record that comes in parts. At its end the delay is that of the whole record."""

    def __init__(self, dt: float):
        self.dt = dt
        self.lags = max(1, round(LONGEST_S / dt))
        self.count = 0
        self._products: Array = np.zeros(2 * self.lags + 1)  # for lags from -lags to lags
        self._power: Array = np.zeros((2, 1))
        self._first: Array = np.zeros((2, 0))
        self._last: Array = np.zeros((2, self.lags))

    def take(self, x_cmd: Array, x_meas: Array) -> None:
        if not len(x_cmd):
            return
        lags, new = self.lags, np.array([x_cmd, x_meas])
        both = np.hstack([self._last, new])
        self._products += _correlated(both, lags)
        if self._last.any():  # pairs of two earlier samples were added before
            self._products -= _correlated(self._last, lags)
        self._power += np.sum(new**2, axis=1, keepdims=True)
        self._first = np.hstack([self._first, new[:, : lags - self._first.shape[1]]])
        self._last = both[:, -lags:]
        self.count += len(x_cmd)

    def value(self) -> float | None:
        searched = min(self.lags, self.count // 4)
        if searched < 1 or not np.all(self._power > 0):
            return None
        products = self._products[self.lags - searched : self.lags + searched + 1]
        r = products / np.sqrt(np.prod(self._paired_power(searched), axis=0))
        at = int(np.argmax(r))
        if not 0 < at < 2 * searched:
            return None
        before, here, after = r[at - 1 : at + 2]
        return float(at - searched + 0.5 * (before - after) / (before - 2 * here + after)) * self.dt

    def _paired_power(self, searched: int) -> Array:
        """Power (2, lags) of command and measured displacement over the pairs of samples at each lag, -searched to searched."""
        start = self._power - np.cumsum(self._first[:, :searched] ** 2, axis=1)  # without the first 1, 2, ... samples
        end = self._power - np.cumsum(self._last[:, ::-1][:, :searched] ** 2, axis=1)
        leading = np.array([start[0], end[1]])[:, ::-1]
        lagging = np.array([end[0], start[1]])
        return np.hstack([leading, self._power, lagging])


def _correlated(both: Array, lags: int) -> Array:
    """sum_i both[0, i] both[1, i + k] over all pairs of samples, at the lags k from -lags to lags.

    scipy.signal would take 1 s to import.
    """
    size = _fast(both.shape[1] + lags)  # the lags do not meet around the end of the transform
    cmd, meas = np.fft.rfft(both, size)
    products = np.fft.irfft(meas * np.conj(cmd), size)
    return np.concatenate([products[-lags:], products[: lags + 1]])


def _fast(least: int) -> int:
    """The smallest length 2^a 3^b 5^c of at least `least`: transforms of such lengths are fast."""
    found = 1 << (least - 1).bit_length()
    for five in (5**power for power in range(8)):
        for three in (3**power for power in range(12)):
            odd = three * five
            found = min(found, odd << (-(-least // odd) - 1).bit_length())
    return found
