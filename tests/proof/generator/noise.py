"""Noise with a known spectrum, from which lambda is computed exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.proof.generator.motion import Array

SMOOTHED = 20.0  # Hz: a reader can smooth a displacement above
TRUSTED = 50.0  # Hz: what a rig records above is not taken for its specimen's


@dataclass(frozen=True)
class Colour:
    """S(f) = sigma^2 ((1 - w) S_1 + w S_2) + s^2 [f < 20 Hz],  S_1 ~ 1 / (1 + (f / f_c)^2) folded,  S_2 ~ 1 / f

    S_1 is the autoregressive process of first order with the corner f_c; S_1 and S_2 have variance one over the band. s is the
    displacement's noise on the output. It is not drawn here, because it comes with the displacement.
    """

    sigma: float
    step: float  # s
    corner: float  # f_c, Hz
    share: float  # w
    taken: float = 0.0  # s, per sample

    def power(self, count: int, whole: bool = True) -> Array:
        """Variance at each frequency of rfft: the mean of |rfft(noise)|^2 / count."""
        angle = np.linspace(0, np.pi, count // 2 + 1)
        pole = np.exp(-2 * np.pi * self.corner * self.step)
        process = (1 - pole**2) / np.abs(1 - pole * np.exp(-1j * angle)) ** 2
        flicker = 1 / np.maximum(np.arange(len(angle)), 1.0)
        flicker[0] = 0.0  # a mean would be an offset, which is an effect
        flicker *= count / (2 * flicker.sum())
        own = self.sigma**2 * ((1 - self.share) * process + self.share * flicker)
        below = angle / (2 * np.pi * self.step) < SMOOTHED
        return np.asarray(own + whole * self.taken**2 * below)

    def drawn(self, random: np.random.Generator, count: int) -> Array:
        white = np.fft.rfft(random.standard_normal(count))
        return np.asarray(np.fft.irfft(white * np.sqrt(self.power(count, whole=False)), count))

    def whitened(self, signal: Array) -> Array:
        """Real vector whose squared length is the signal's energy over the noise's, frequency by frequency up to TRUSTED."""
        count = len(signal)
        used = np.fft.rfftfreq(count, self.step) <= TRUSTED
        weight = np.where(np.arange(count // 2 + 1) % (count / 2), 2.0, 1.0)  # both ends are there once
        found = (np.fft.rfft(signal) * np.sqrt(weight / (count * self.power(count))))[used]
        return np.concatenate([found.real, found.imag])
