"""Frequency evaluation index FEI = sum_j (Y_m / Y_c) |Y_c|^2 / sum_j |Y_c|^2 = sum_j Y_m Y_c* / sum_j |Y_c|^2 over f_j > 0.

Y_c and Y_m: Fourier transforms of command and measured displacement (samples), every `dt` (s). The generalised amplitude is
A = |FEI| (number; 1 is perfect), the generalised delay d = -arg(FEI) / (2 pi f_eq) (s; positive: lag), the equivalent frequency
f_eq = sum_j |Y_c|^2 f_j / sum_j |Y_c|^2. Guo, Chen, Xu and Christenson (2014), with their exponent l = 2, and without f = 0,
where an offset has no phase.

Not valid where the command has a wide range of frequencies: a pure delay then lowers A below 1, and d follows the frequencies
of the largest power.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
SEGMENT_S = 16.0  # several cycles of the slowest structure that is usually tested
FINEST_RATE = 1024.0  # Hz; far above the frequencies of a structure


class Evaluation(NamedTuple):
    """Generalised amplitude (number) and delay (s)."""

    amplitude: float
    delay: float


def frequency_evaluation(x_cmd: Array, x_meas: Array, dt: float) -> Evaluation | None:
    """Amplitude and delay over the whole record; None where the command never moved."""
    return _evaluated(_sums(x_cmd, x_meas, dt))


class RunningFrequency:
    """The same sums over segments that overlap by half under w = sin(pi (i + 1/2) / n), so that the w^2 add up to 1.

    Motion with more than about two cycles in SEGMENT_S gives the values of the whole record. Slower motion loses its phase.
    Samples at more than FINEST_RATE are averaged in groups. Before its start the record is at rest.
    """

    def __init__(self, dt: float):
        self.group = max(1, round(1.0 / (dt * FINEST_RATE)))
        self.dt = dt * self.group
        self.length = 2 * max(1, round(SEGMENT_S / self.dt / 2))
        self._window = np.sin(np.pi * (np.arange(self.length) + 0.5) / self.length)
        self._total: Array = np.zeros(4)
        self._open: Array = np.zeros((2, self.length // 2))
        self._fine: Array = np.zeros((2, 0))

    def take(self, x_cmd: Array, x_meas: Array) -> None:
        fine = np.hstack([self._fine, [x_cmd, x_meas]])
        whole = fine.shape[1] // self.group * self.group
        self._fine = fine[:, whole:]
        self._open = np.hstack([self._open, fine[:, :whole].reshape(2, -1, self.group).mean(axis=2)])
        while self._open.shape[1] >= self.length:
            self._total += self._segment(self._open[:, : self.length])
            self._open = self._open[:, self.length // 2 :]

    def value(self) -> Evaluation | None:
        """Amplitude and delay so far, from the complete segments and the two current segments, which are padded with zeros."""
        half = self.length // 2
        rest = np.pad(self._open, ((0, 0), (0, self.length + half - self._open.shape[1])))
        return _evaluated(self._total + self._segment(rest[:, : self.length]) + self._segment(rest[:, half:]))

    def _segment(self, pair: Array) -> Array:
        return _sums(pair[0] * self._window, pair[1] * self._window, self.dt)


def _sums(x_cmd: Array, x_meas: Array, dt: float) -> Array:
    """Sums over f > 0 of Re and Im of Y_m conj(Y_c), |Y_c|^2, and f |Y_c|^2."""
    if not len(x_cmd):
        return np.zeros(4)
    cmd, meas = np.fft.rfft(x_cmd)[1:], np.fft.rfft(x_meas)[1:]
    power = np.abs(cmd) ** 2
    cross = np.sum(meas * np.conj(cmd))
    return np.array([cross.real, cross.imag, np.sum(power), np.sum(power * np.fft.rfftfreq(len(x_cmd), dt)[1:])])


def _evaluated(sums: Array) -> Evaluation | None:
    real, imaginary, power, moment = sums
    if not power > 0:
        return None
    index = complex(real, imaginary) / power
    return Evaluation(abs(index), -float(np.angle(index)) / (2 * np.pi * float(moment / power)))
