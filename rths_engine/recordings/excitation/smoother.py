"""Smoothing of a measured displacement by a Wiener filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_dilation, binary_propagation, uniform_filter

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.excitation.stretches import Stretches

# chosen; see docs/decisions/0023
STRETCH = 2.0  # s, duration of the spectrum of a stretch
HOPS = 8  # hops in a stretch
AROUND = (5, 5)  # frequencies and hops over which powers are averaged
WIDELY, FAINT = (15, 13), 0.4  # the same for motion hidden in noise; smallest power of hidden motion over the noise floor
NEAR = (31, 9)  # frequencies and hops around clear motion in which motion may be hidden
CLEAR, ABOVE_FLOOR = 8.0, 2.0  # power over the noise floor: of clear motion; of motion kept beside clear motion


@dataclass(frozen=True)
class Smoother:
    """Wiener filter of a displacement: it keeps the share G = 1 - floor / power of each stretch and frequency with motion.

    Source: Wiener (1949), Extrapolation, Interpolation, and Smoothing of Stationary Time Series, applied to stretches of
    STRETCH seconds. The filter assumes white noise and fails first where the noise is not white.
    """

    stretches: Stretches
    kept: Array  # G (frequencies, stretches)
    unsure: Array  # G, or the power over the noise floor of motion that is hidden in noise and lost
    noise: float  # standard deviation of the white noise of the displacement, m

    @classmethod
    def of(cls, displacement: Array, dt: float) -> Smoother:
        hop = max(1, round(STRETCH / (HOPS * dt)))
        stretches = Stretches.of(hop, HOPS, dt)
        each = np.abs(stretches.spectra(_padded(displacement, stretches.length)).T) ** 2
        first = 2 * HOPS + HOPS // 2 - 1  # the stretch about the first sample of the recording, behind its continuation
        inside = slice(first, first + len(displacement) // hop)
        floor = float(np.median(each[len(each) // 2 : -1, inside])) / np.log(2)  # median of an exponential law over its mean
        power = uniform_filter(each, AROUND, mode="nearest")
        clear = binary_propagation(power > CLEAR * floor, mask=power > ABOVE_FLOOR * floor)
        kept = np.where(clear, 1 - floor / np.maximum(power, max(floor, 1e-300)), 0.0)
        kept[:3] = 1.0  # the mean and motion slower than a stretch are kept
        hidden = uniform_filter(np.where(clear, 0.0, power - floor), WIDELY, mode="nearest") / max(floor, 1e-300)
        near = binary_dilation(clear, np.ones(NEAR, bool)) & (hidden > FAINT)
        unsure = np.where(kept > 0, kept, np.where(near, np.minimum(hidden, 1.0), 0.0))
        return cls(stretches, kept, unsure, float(np.sqrt(floor / dt)))

    def smoothed(self, displacement: Array) -> Array:
        return self._filtered(displacement, self.kept) if self.noise > 0 else displacement

    def error(self, count: int, random: np.random.Generator) -> Array:
        """A draw of the error of a smoothed displacement: kept noise and lost motion, with the spectrum floor * G."""
        return self._filtered(self.noise * random.standard_normal(count), np.sqrt(self.unsure))

    def _filtered(self, signal: Array, share: Array) -> Array:
        length = self.stretches.length
        padded = _padded(signal, length)
        found = self.stretches.signal(self.stretches.spectra(padded) * share.T, len(padded))
        inside: Array = found[2 * length : 2 * length + len(signal)]
        return inside


def _padded(signal: Array, length: int) -> Array:
    padded = np.pad(signal, 2 * length, "reflect", reflect_type="odd")
    fade = np.sin(np.linspace(0, np.pi / 2, length)) ** 2
    padded[:length] *= fade
    padded[-length:] *= fade[::-1]
    return padded
