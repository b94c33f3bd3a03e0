"""The noise of a recording: its level and its spectrum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_toeplitz, toeplitz

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
ORDER, LONG = 12, 128  # order of the short process, which fits the filter's stop band; order of a whitener for slow noise

# chosen; see docs/decisions/0023
LEAST_SAMPLES = 20  # fewest samples for each coefficient of a process
LEAST_FLOOR, MOST_FLOOR = 0.3, 10.0  # limits of the white floor, as shares of the power of the noise
CORNERS = (0.0003, 0.001, 0.003, 0.01, 0.03, 0.1)  # corner frequencies, as shares of the sampling rate
GRID = 4096  # frequencies of a spectrum
FREQUENCY = np.linspace(0.0, 0.5, GRID + 1)  # shares of the sampling rate
ITERATIONS = 100
TURNS = 3


@dataclass(frozen=True, slots=True)
class Noise:
    """The noise of a channel: its `spectrum` (GRID + 1) and its `whitener`.

    The spectrum is the mean of |rfft|^2 over the number of samples, from 0 to half the sampling rate. The `whitener`, in units
    of `scale`, whitens the noise plus a white floor. Because of the floor, all frequencies have similar weights.
    """

    spectrum: Array
    whitener: Array
    scale: float

    @classmethod
    def white(cls, sigma: float) -> Noise:
        return cls(np.full(GRID + 1, sigma**2), np.ones(1), sigma)

    def times(self, unit: float, least: float) -> Noise:
        """The noise multiplied by `unit`, and increased so that its scale is at least `least` times `unit`."""
        more = unit * max(1.0, least / max(self.scale, 1e-300))
        return Noise(self.spectrum * more**2, self.whitener, self.scale * more)

    def whitened(self, signals: Array) -> Array:
        """The whitened signals (samples along the last axis), in units of the noise."""
        rows = np.reshape(signals, (-1, np.shape(signals)[-1]))
        taps = self.whitener / self.scale
        white = [np.convolve(row, taps)[: rows.shape[1]] for row in rows]
        return np.reshape(white, np.shape(signals))

    def drawn(self, count: int, random: np.random.Generator) -> Array:
        long = 2 * count  # twice as long, so that the end of the draw is not correlated with its start
        power = np.interp(np.fft.rfftfreq(long), FREQUENCY, self.spectrum)
        drawn: Array = np.fft.irfft(np.sqrt(power) * np.fft.rfft(random.standard_normal(long)), long)[:count]
        return drawn

    @property
    def deviation(self) -> float:
        """Standard deviation of the noise before whitening."""
        return float(np.sqrt(np.mean(self.spectrum)))


def coloured(stretches: Sequence[Array], beyond: float = 0.0) -> Noise:
    """Estimate the noise from stretches of it, about their mean.

    The model is a short autoregressive process times a spectrum that rises towards low frequencies; both are estimated in turn.
    The white floor of the whitener has `beyond` times the power of the noise, because models have errors of this size. All
    frequencies then have similar weights.
    """
    count = sum(len(one) for one in stretches)
    mean = sum(float(one.sum()) for one in stretches) / count
    powers = [np.abs(np.fft.rfft(one - mean)) ** 2 / len(one) for one in stretches]
    order, variance = (
        min(ORDER, max(0, count // LEAST_SAMPLES)),
        sum(float(np.sum((one - mean) ** 2)) for one in stretches) / count,
    )
    if order == 0 or variance <= 0:
        return Noise.white(float(np.sqrt(max(variance, np.finfo(float).tiny))))
    slow = np.eye(len(CORNERS) + 1)[0]
    for _ in range(TURNS):
        covariance = np.zeros(order + 1)
        for one, power in zip(stretches, powers, strict=True):
            lags = np.fft.irfft(power / (slow @ _shapes(_frequencies(one))), len(one))
            covariance += lags[: order + 1] * len(one) / count
        short, sigma = _predictor(covariance, 0.0)
        rest = [power / _peaks(short, sigma, _frequencies(one)) for one, power in zip(stretches, powers, strict=True)]
        known = np.concatenate([_frequencies(one)[1:] for one in stretches])
        slow = _risen(known, np.concatenate([one[1:] for one in rest]))
    spectrum = (slow @ _shapes(FREQUENCY)) * _peaks(short, sigma, FREQUENCY)
    covariance = np.fft.irfft(spectrum)[: min(LONG, max(order, count // LEAST_SAMPLES)) + 1]
    return Noise(spectrum, *_predictor(covariance, min(max(beyond, LEAST_FLOOR), MOST_FLOOR)))


def _frequencies(stretch: Array) -> Array:
    return np.fft.rfftfreq(len(stretch))


def _peaks(coefficients: Array, sigma: float, frequency: Array) -> Array:
    """The spectrum of an autoregressive process."""
    lags = np.arange(len(coefficients))
    response = np.exp(-2j * np.pi * np.outer(frequency, lags)) @ coefficients
    found: Array = sigma**2 / np.abs(response) ** 2
    return found


def _risen(frequency: Array, power: Array) -> Array:
    """Weights of a constant and of first-order processes whose sum fits a periodogram with the largest likelihood.

    Source: Whittle (1953), Ark. Mat. 2, 423-434; its maximum by the updates of Fevotte, Bertin and Durrieu (2009), Neural
    Comput. 21, 793-830, for the Itakura-Saito distance.
    """
    parts = _shapes(frequency)
    weights = np.full(len(parts), float(np.mean(power)) / len(parts))
    for _ in range(ITERATIONS):
        spectrum = weights @ parts
        weights = weights * np.sqrt((parts @ (power / spectrum**2)) / (parts @ (1 / spectrum)))
    return weights


def _shapes(frequency: Array) -> Array:
    """Spectra (parts, frequencies) of a constant and of the first-order processes with the CORNERS."""
    return np.array([np.ones(len(frequency)), *(1 / (1 + (frequency / corner) ** 2) for corner in CORNERS)])


def _predictor(covariance: Array, floor: float) -> tuple[Array, float]:
    """Coefficients of the linear predictor, and the standard deviation of its error for the noise without the floor."""
    held = covariance.copy()
    held[0] *= 1 + floor
    coefficients = np.concatenate([[1.0], solve_toeplitz(held[:-1], -held[1:])])
    power = coefficients @ toeplitz(covariance) @ coefficients
    return coefficients, float(np.sqrt(max(power, 1e-12 * covariance[0])))
