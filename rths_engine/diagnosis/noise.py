"""The noise of a recording: its level and its colour."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from rths_engine.arrays import Array

ORDER = 12  # the stop band of the decimation takes as many


@dataclass(frozen=True, slots=True)
class Noise:
    """n[i] + a_1 n[i-1] + ... = sigma e[i], with e white and of unit variance."""

    coefficients: Array  # 1, a_1, ...
    sigma: float

    def whitened(self, signals: Array) -> Array:
        """The signals (samples along the last axis) in units of the noise, made white."""
        white: Array = lfilter(self.coefficients, [self.sigma], signals, axis=-1)
        return white

    def drawn(self, count: int, random: np.random.Generator) -> Array:
        white = random.standard_normal(count + 50 * len(self.coefficients))
        drawn: Array = lfilter([self.sigma], self.coefficients, white)[-count:]
        return drawn

    @property
    def deviation(self) -> float:
        """Standard deviation of the noise itself."""
        impulse = lfilter([self.sigma], self.coefficients, np.eye(1, 4000)[0])
        return float(np.sqrt(np.sum(impulse**2)))


def autoregressive(stretches: Sequence[Array], order: int = ORDER) -> Noise:
    """The autoregressive process of stretches of noise, by Yule and Walker."""
    count = sum(len(one) for one in stretches)
    order = min(order, max(0, count // 20))
    covariance = np.zeros(order + 1)
    for one in stretches:
        covariance += [one[: len(one) - lag] @ one[lag:] / count for lag in range(order + 1)]
    if order == 0 or covariance[0] <= 0:
        return Noise(np.ones(1), float(np.sqrt(max(covariance[0], np.finfo(float).tiny))))
    weights = solve_toeplitz(covariance[:-1], -covariance[1:])
    power = covariance[0] + covariance[1:] @ weights
    return Noise(np.concatenate([[1.0], weights]), float(np.sqrt(max(power, 1e-12 * covariance[0]))))
