"""The band of the comparison: a zero-phase low-pass filter and every n-th sample of it."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.band import Band

DT = 1 / 1024
TIME = DT * np.arange(8192)
INSIDE = slice(60, -60)  # samples beyond the filter's half length, 20 samples of the decimated signal, at either end


def test_signals_slower_than_the_analysis_pass_unchanged() -> None:
    band = Band.of(0.01)
    signal = np.random.default_rng(1).standard_normal(100)
    assert band.factor == 1 and band.step == 0.01
    assert np.array_equal(band.reduced(signal), signal)


@pytest.mark.parametrize(("rate", "factor"), [(128, 1), (255, 1), (256, 2), (1024, 8), (5000, 39)])
def test_the_factor_is_the_largest_that_keeps_128_samples_a_second(rate: int, factor: int) -> None:
    assert Band.of(1 / rate).factor == factor


@pytest.mark.parametrize("frequency", [0.5, 5.0, 25.0, 44.0])
def test_a_sine_in_the_band_keeps_its_size_and_its_phase(frequency: float) -> None:
    """A delay of one sample of the recording at 44 Hz would be an error of 0.27; the Hamming window's ripple is 0.2 %."""
    band = Band.of(DT)
    sine = np.sin(2 * np.pi * frequency * TIME + 0.3)
    assert band.reduced(sine)[INSIDE] == pytest.approx(sine[:: band.factor][INSIDE], abs=3e-3)


@pytest.mark.parametrize("frequency", [58.0, 64.0, 100.0, 300.0, 500.0])
def test_what_would_be_folded_into_the_band_is_stopped(frequency: float) -> None:
    """By 53 dB, as a Hamming window does; its transition is 3.3 / 321 of 1024 Hz wide, about the edge at 51.2 Hz."""
    assert np.max(np.abs(Band.of(DT).reduced(np.sin(2 * np.pi * frequency * TIME))[INSIDE])) < 10 ** (-53 / 20)


def test_a_constant_stays_to_its_ends() -> None:
    assert Band.of(DT).reduced(np.full(4096, 3.0)) == pytest.approx(3.0, rel=1e-12)  # taps sum to 1


@pytest.mark.parametrize("count", [1000, 1001, 1007, 1008])
def test_only_whole_steps_are_kept(count: int) -> None:
    assert len(Band.of(DT).reduced(np.zeros(count))) == count // 8
