"""Overlapping stretches of a signal: their spectra, and the signal that filtered spectra give."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.fft import irfft, rfft, rfftfreq

from rths_engine.foundation.arrays import Array


@dataclass(frozen=True)
class Stretches:
    """Stretches of `hops` x `hop` samples, one every `hop` samples, under a Blackman-Harris window.

    The first stretch ends with the first `hop` samples, and the last stretch begins with the last ones. |spectrum|^2 is a power
    spectral density (unit^2 / Hz, both sides of zero). Source: Allen and Rabiner (1977), Proc. IEEE 65, 1558-1564.
    """

    hop: int
    hops: int
    dt: float
    window: Array
    dual: Array  # window of the overlapping sum, which gives the signal back

    @classmethod
    def of(cls, hop: int, hops: int, dt: float) -> Stretches:
        from scipy.signal.windows import blackmanharris

        window = blackmanharris(hops * hop, sym=False)
        window *= np.sqrt(dt / np.sum(window**2))
        whole = np.sum(window.reshape(hops, hop) ** 2, axis=0)
        return cls(hop, hops, dt, window, window / np.tile(whole, hops))

    @property
    def length(self) -> int:
        return len(self.window)

    @property
    def frequencies(self) -> Array:
        """The frequencies of a spectrum (Hz)."""
        return np.asarray(rfftfreq(self.length, self.dt))

    def spectra(self, signal: Array) -> Array:
        """Spectra (stretches, frequencies)."""
        before = self.length - self.hop
        after = before + -len(signal) % self.hop
        views = sliding_window_view(np.pad(signal, (before, after)), self.length)[:: self.hop]
        return np.asarray(rfft(views * self.window, axis=1))

    def signal(self, spectra: Array, samples: int) -> Array:
        """The first samples of the signal that has these spectra."""
        rows = irfft(spectra, self.length, axis=1) * self.dual
        count = len(rows)
        total = np.zeros((count + self.hops - 1, self.hop))
        for place, part in enumerate(rows.reshape(count, self.hops, self.hop).swapaxes(0, 1)):
            total[place : place + count] += part
        found: Array = total.reshape(-1)[self.length - self.hop :][:samples]
        return found
