"""The held-out gain of an effect and its interval."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.gain import Gain, Scale, gain
from rths_engine.foundation.arrays import Array

BLOCKS = [(0, slice(100 * place, 100 * place + 100)) for place in range(10)]


def gained(size: float, seed: int, share: float = 1.0, acts: slice = slice(None)) -> Gain:
    """The gain where the output lacks `size` times a sine and the effect adds `share` of it, beside white noise of size 1."""
    noise = np.random.default_rng(seed).standard_normal((1, 1000))
    change = np.zeros((1, 1000))
    change[:, acts] = size * np.sin(np.arange(1000))[acts]
    left: Array = noise + (1 - share) * change
    return gain(Scale(1.0, 1.0), [left], [noise + change], BLOCKS, True)


def test_the_gain_is_half_the_squared_change_that_the_effect_explains() -> None:
    found = gained(1.0, 1)
    assert found.mean == pytest.approx(0.5 * 50, rel=0.2)  # 100 samples of sin^2
    assert found.felt == pytest.approx(500, rel=0.01) and found.blocks == 10 and found.clear


def test_a_change_that_the_recording_does_not_have_loses_half_its_square() -> None:
    """The output has no sine; the effect adds one: r + d is noise, r is noise minus the sine."""
    noise = np.random.default_rng(2).standard_normal((1, 1000))
    change = np.sin(np.arange(1000))[None]
    found = gain(Scale(1.0, 1.0), [noise - change], [noise], BLOCKS, True)
    assert found.mean < -20 and not found.clear


def test_ninety_percent_intervals_hold_the_expected_gain() -> None:
    """Of noise, the expected gain per block is half of d^2: 25."""
    hits = [low <= 0.5 * 50 <= high for low, high in (gained(1.0, seed).ci90 for seed in range(200))]
    assert 0.82 < np.mean(hits) <= 0.99


def test_an_effect_that_acts_in_one_block_is_not_punished_for_the_others() -> None:
    found = gained(2.0, 3, acts=slice(300, 400))
    assert found.clear


def test_an_effect_that_does_not_act_in_the_data_is_not_tested() -> None:
    found = gained(0.0, 4)
    assert not found.tested and not found.clear and found.mean == 0


def test_two_recordings_replicate_a_gain_if_each_has_it() -> None:
    noise = [np.random.default_rng(seed).standard_normal((1, 1000)) for seed in (5, 6)]
    change = np.sin(np.arange(1000))[None]
    blocks = [(place, cut) for place in (0, 1) for _, cut in BLOCKS]
    both = gain(Scale(1.0, 1.0), noise, [one + change for one in noise], blocks, True)
    assert both.replicated and len(both.by_set) == 2
    one = gain(Scale(1.0, 1.0), [noise[0], noise[1] - change], [noise[0] + change, noise[1]], blocks, True)
    assert not one.replicated


def test_a_larger_misfit_and_a_longer_memory_lower_the_score() -> None:
    rows = [np.ones((1, 1000))]
    plain, tempered = (scale.scores(rows, BLOCKS) for scale in (Scale(1.0, 1.0), Scale(4.0, 5.0)))
    assert plain == pytest.approx([-50.0] * 10) and tempered == pytest.approx(plain / 20)
