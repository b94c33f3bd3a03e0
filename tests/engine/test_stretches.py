"""Spectra of overlapping stretches, and the signal that they give back."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import ShortTimeFFT

from rths_engine.recordings.excitation.stretches import Stretches

RANDOM = np.random.default_rng(5)


@pytest.mark.parametrize("samples", [5, 640, 1001])
def test_spectra_that_are_not_changed_give_the_signal_back(samples: int) -> None:
    signal = RANDOM.standard_normal(samples)
    stretches = Stretches.of(16, 8, 0.01)
    assert stretches.signal(stretches.spectra(signal), samples) == pytest.approx(signal, abs=1e-12)


@pytest.mark.parametrize("hop", [3, 25])
def test_powers_are_those_of_scipys_short_time_spectra(hop: int) -> None:
    """SciPy turns the phases of its spectra to the middle of each stretch; powers do not depend on it."""
    signal, dt = RANDOM.standard_normal(40 * hop + 1), 0.01
    ours = Stretches.of(hop, 8, dt)
    theirs = ShortTimeFFT(ours.window, hop, 1 / dt).stft(signal)
    assert pytest.approx(np.abs(theirs), abs=1e-12) == np.abs(ours.spectra(signal)).T


def test_white_noise_has_its_variance_over_the_sampling_rate_as_density() -> None:
    """The mean of 400 independent stretches scatters by 5 %, of all frequencies by far less."""
    dt, sigma = 0.01, 2.0
    stretches = Stretches.of(16, 8, dt)
    power = np.abs(stretches.spectra(sigma * RANDOM.standard_normal(128 * 400))) ** 2
    assert float(np.mean(power[8:-8, 1:-1])) == pytest.approx(sigma**2 * dt, rel=0.03)
    assert stretches.frequencies[-1] == pytest.approx(0.5 / dt)
