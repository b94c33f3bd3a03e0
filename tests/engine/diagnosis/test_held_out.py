"""Held-out data: masks, blocks and errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.held_out import SHORTEST, HeldOut
from rths_engine.diagnosis.judge import fitted_blocks
from tests.engine.diagnosis.made import DT, Gain, drive, driven, linear, noisy, recordings

USED = replace(recordings(linear(), noisy([Gain()], 1)), masks=(fitted_blocks(600, DT),))


def test_without_a_held_out_recording_the_blocks_that_were_not_fitted_are_held_out() -> None:
    held = HeldOut.of(USED, ())
    assert not held.other_motion and np.array_equal(held.masks[0], inner(600, DT) & ~fitted_blocks(600, DT))
    assert len(held.blocks(1.0)) == 3


def test_a_held_out_recording_is_cut_into_blocks_of_two_seconds_and_three_correlation_lengths() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 2, 3000),))
    for memory, least in ((1.0, SHORTEST), (100.0, 3.0)):
        blocks = held.blocks(memory)
        lengths = [DT * (cut.stop - cut.start) for _, cut in blocks]
        assert min(lengths) >= least - DT and max(lengths) < 2 * least
        assert sum(lengths) == pytest.approx(DT * held.masks[0].sum())
    assert held.other_motion


def test_the_error_of_the_truth_is_the_noise() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 3, 3000),))
    assert held.error(held.residuals([Gain()])) == pytest.approx(held.noise, rel=0.1)


def test_the_zero_of_a_force_is_fitted_freely() -> None:
    """The component's output is a force: a constant error of a held-out recording costs nothing."""
    data = noisy([Gain()], 4, 3000)
    moved = driven(data.measured[0] + 1.0, drive(3000))
    component = linear()
    held = HeldOut.of(replace(USED, component=component), (moved,))
    free = held.error(held.residuals([Gain()])) < 2 * held.noise
    assert free is (component.output == "force")
    strict = replace(held, zeros_free=False)
    assert strict.error(strict.residuals([Gain()])) > 10 * held.noise


def test_the_memory_of_white_noise_is_a_sample_and_of_a_slow_process_its_own() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 5, 3000),))
    white = np.random.default_rng(6).standard_normal((1, 3000))
    assert held.memory([white]) == pytest.approx(1.0, abs=0.2)
    slow = lfilter([1.0], [1.0, -0.9], white)  # 1 + 2 * 0.9 / (1 - 0.9) = 19
    assert held.memory([slow]) == pytest.approx(19, rel=0.4)


def test_a_slow_residual_and_an_effect_that_oscillates_have_a_short_memory_together() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 7, 3000),))
    slow = lfilter([1.0], [1.0, -0.98], np.random.default_rng(8).standard_normal((1, 3000)))
    wave = np.sin(np.arange(3000) * 2 * np.pi / 20)[None]
    assert held.memory([slow], [wave]) < 0.2 * held.memory([slow])
    assert held.memory([slow], [np.ones((1, 3000))]) > 0.4 * held.memory([slow])


def test_residuals_far_above_the_noise_are_not_whitened() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 9, 3000),))
    assert held.suited([Gain()]).white
    assert not held.suited([Gain(gain=6.0)]).white


def test_the_quietest_block_limits_a_noise_that_was_fitted_too_large() -> None:
    """Noise of ten times its size was fitted: the quietest block shows that."""
    loud = replace(USED, noises=tuple(one.times(10.0, 0.0) for one in USED.noises))
    held = HeldOut.of(loud, (noisy([Gain()], 10, 3000),)).suited([Gain()])
    assert held.noise == held.quiet == pytest.approx(HeldOut.of(USED, held.data).noise, rel=0.3)


def test_data_that_cannot_test_an_effect_alone_are_joined_with_the_fitted_ones() -> None:
    held = HeldOut.of(USED, (noisy([Gain()], 11, 3000),)).with_fitted()
    assert len(held.data) == 2 and not held.other_motion and held.samples > USED.samples
    same = HeldOut.of(USED, ()).with_fitted()
    assert len(same.data) == 1 and np.array_equal(same.masks[0], inner(600, DT))
