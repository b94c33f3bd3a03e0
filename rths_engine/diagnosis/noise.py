"""The noise of a recording: its level and its colour."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_toeplitz, toeplitz
from scipy.signal import lfilter

from rths_engine.arrays import Array

ORDER = 12  # the stop band of the decimation takes as many


@dataclass(frozen=True, slots=True)
class Noise:
    """n[i] + a_1 n[i-1] + ... = sigma e[i], with e white and of unit variance. `whitener`, likewise, is of the noise with a
    white floor: by it no frequency counts for much more than the others."""

    coefficients: Array  # 1, a_1, ...
    sigma: float
    whitener: Array
    scale: float

    @classmethod
    def white(cls, sigma: float) -> Noise:
        return cls(np.ones(1), sigma, np.ones(1), sigma)

    def times(self, unit: float, least: float) -> Noise:
        """In another unit, and no smaller than `least` of it."""
        more = max(1.0, least / max(self.scale, 1e-300))
        return Noise(self.coefficients, unit * more * self.sigma, self.whitener, unit * more * self.scale)

    def whitened(self, signals: Array) -> Array:
        """The signals (samples along the last axis) in units of the noise, made white."""
        white: Array = lfilter(self.whitener, [self.scale], signals, axis=-1)
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


LEAST_FLOOR, MOST_FLOOR = 0.3, 10.0  # of the noise's power, white beside it


def autoregressive(stretches: Sequence[Array], beyond: float = 0.0) -> Noise:
    """The autoregressive process of stretches of noise, about their mean, by Yule and Walker. The white floor of its whitener
    has `beyond` times the noise's power, where models err by as much: then no frequency counts for much more than others."""
    count = sum(len(one) for one in stretches)
    mean = sum(float(one.sum()) for one in stretches) / count
    stretches = [one - mean for one in stretches]
    order = min(ORDER, max(0, count // 20))
    covariance = np.zeros(order + 1)
    for one in stretches:
        covariance += [one[: len(one) - lag] @ one[lag:] / count for lag in range(order + 1)]
    if order == 0 or covariance[0] <= 0:
        return Noise.white(float(np.sqrt(max(covariance[0], np.finfo(float).tiny))))
    return Noise(*_predictor(covariance, 0.0), *_predictor(covariance, min(max(beyond, LEAST_FLOOR), MOST_FLOOR)))


def _predictor(covariance: Array, floor: float) -> tuple[Array, float]:
    """Coefficients and the deviation of what they leave of the noise."""
    held = covariance.copy()
    held[0] *= 1 + floor
    coefficients = np.concatenate([[1.0], solve_toeplitz(held[:-1], -held[1:])])
    power = coefficients @ toeplitz(covariance) @ coefficients
    return coefficients, float(np.sqrt(max(power, 1e-12 * covariance[0])))
