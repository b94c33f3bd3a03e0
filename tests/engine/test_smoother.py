"""A displacement freed of white noise, beside motion and noise that are known."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.excitation.smoother import Smoother

DT = 1 / 256
TIME = DT * np.arange(16 * 256)
MOTION = 0.01 * np.sin(2 * np.pi * 0.8 * TIME) * np.sin(0.3 * TIME) + 0.004 * np.sin(2 * np.pi * 2.3 * TIME + 1)
SIGMA = 2e-5


def read(seed: int, sigma: float = SIGMA) -> Array:
    found: Array = MOTION + sigma * np.random.default_rng(seed).standard_normal(len(TIME))
    return found


@pytest.mark.parametrize("sigma", [2e-6, SIGMA, 2e-4])
def test_the_deviation_of_the_noise_is_found(sigma: float) -> None:
    """The median of some 10 000 overlapping powers, a third of them independent: 2 %; three of it."""
    assert Smoother.of(read(1, sigma), DT).noise == pytest.approx(sigma, rel=0.06)


def test_a_few_lines_of_motion_are_kept_and_nine_tenths_of_the_noises_power_is_gone() -> None:
    noisy = read(2)
    error = Smoother.of(noisy, DT).smoothed(noisy) - MOTION
    assert np.var(error) < 0.1 * SIGMA**2
    assert np.max(np.abs(error)) < 4 * SIGMA  # the ends too, where the record is continued by its mirror image


def test_white_noise_alone_is_smoothed_to_little() -> None:
    """What is slower than a stretch is always kept: 3 of 257 frequencies, wider by the window, beside what chance lifts."""
    noise = SIGMA * np.random.default_rng(3).standard_normal(len(TIME))
    smoother = Smoother.of(noise, DT)
    assert np.var(smoother.smoothed(noise)) < 0.05 * SIGMA**2


def test_motion_far_above_the_noise_is_not_changed() -> None:
    """Wiener's share is 1 - floor / power. At the ends, where the mirror image has a kink, some of it is lost in noise."""
    clear = MOTION + 1e-9 * np.random.default_rng(4).standard_normal(len(TIME))
    found = Smoother.of(clear, DT).smoothed(clear)
    assert found[20:-20] == pytest.approx(MOTION[20:-20], abs=5e-9)
    assert found == pytest.approx(MOTION, abs=1e-5 * np.max(np.abs(MOTION)))


def test_a_still_record_is_left_alone() -> None:
    still = np.zeros(2048)
    smoother = Smoother.of(still, DT)
    assert smoother.noise == 0 and np.array_equal(smoother.smoothed(still), still)


def test_the_kept_share_is_wieners_where_motion_stands_clear_and_nothing_elsewhere() -> None:
    smoother = Smoother.of(read(5), DT)
    assert np.all((smoother.kept >= 0) & (smoother.kept <= 1)) and np.all(smoother.kept[:3] == 1)
    frequency = smoother.stretches.frequencies
    inside = slice(20, -20)
    assert np.min(smoother.kept[np.argmin(np.abs(frequency - 2.3)), inside]) > 0.999  # 4 mm beside 20 um
    assert np.max(smoother.kept[frequency > 30, inside]) < 0.9 and np.mean(smoother.kept[frequency > 30] > 0) < 0.02


def test_what_the_smoothed_motion_may_be_off_by_is_of_the_size_of_its_error() -> None:
    """Of 30 records: the power that `error` draws beside the power of the true error, within a factor of 2."""
    true, told = [], []
    for seed in range(10, 40):
        noisy = read(seed)
        smoother = Smoother.of(noisy, DT)
        true.append(np.var(smoother.smoothed(noisy) - MOTION))
        told.append(np.var(smoother.error(len(TIME), np.random.default_rng(seed))))
    assert 0.5 < np.mean(told) / np.mean(true) < 2.0


@pytest.mark.parametrize("count", [400, 1001, 4096])
def test_a_smoothed_record_is_as_long_as_it_was(count: int) -> None:
    noisy = read(6)[:count]
    smoother = Smoother.of(noisy, DT)
    assert len(smoother.smoothed(noisy)) == count == len(smoother.error(count, np.random.default_rng(7)))
