"""The noise of a recording, of what its models leave."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.noise_of import FIRST_GUESS, LEAST_NOISE, _clear, first_noise, weighted, with_noise
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import DT, SAMPLES, SIGMA, Driven, Gain, Linear, Wave, drive, driven, linear, noisy, recordings


def test_the_first_noise_is_a_hundredth_of_the_output() -> None:
    data = noisy([Gain()], 1)
    used = first_noise(recordings(linear(), data, sigma=77.0))
    assert used.noises[0].deviation == pytest.approx(FIRST_GUESS * np.std(data.out), rel=1e-12)


@pytest.mark.parametrize("left_out", [[], [Wave(size=1.0, storey=1)], [Wave(size=1.0, storey=4), Wave(size=2.0, storey=2)]])
def test_an_effect_that_was_left_out_is_not_taken_for_noise(left_out: list[Wave]) -> None:
    """The fit leaves up to ten times the noise. An estimate of 600 samples errs by 1 / sqrt(1200); 0.15 is five times that."""
    used = first_noise(recordings(linear(), noisy([Gain(gain=2.1), *left_out], 2)))
    found = with_noise(used, fit(used, [Gain()]))
    assert found.noises[0].deviation == pytest.approx(SIGMA, rel=0.15)


def test_noise_of_a_file_without_any_is_its_rounding() -> None:
    data = driven(2.0 * drive())
    used = first_noise(recordings(linear(), data))
    found = with_noise(used, fit(used, [Gain()])).noises[0]
    assert found.scale == pytest.approx(LEAST_NOISE * np.std(data.out), rel=1e-6)


def test_samples_of_a_while_that_is_noisier_count_less() -> None:
    """Ten times the noise over a third of the recording: a share of sqrt(1.5 / 100) of the others', about."""
    random = np.random.default_rng(3)
    louder = np.where((np.arange(1500) > 500) & (np.arange(1500) < 1000), 10.0, 1.0)
    data = driven(2 * drive(1500) + SIGMA * louder * random.standard_normal(1500))
    used = first_noise(recordings(linear(), data))
    found = with_noise(used, fit(used, [Gain()]))
    weights = found.weights[0][0]
    inside, outside = weights[600:900], np.concatenate([weights[:400], weights[1100:]])
    assert np.median(outside) > 0.9
    assert 0.5 * np.sqrt(1.5 / 100) < np.median(inside) < 2 * np.sqrt(1.5 / 100)
    assert found.noises[0].deviation < 3 * SIGMA  # and not the RMS of both, 5.8 of it


def test_even_noise_leaves_the_samples_alike() -> None:
    used = first_noise(recordings(linear(), noisy([Gain()], 4)))
    weights = with_noise(used, fit(used, [Gain()])).weights[0]
    assert np.mean(weights) > 0.95  # a second's power of 100 samples is beyond 1.5 of the median by chance only


def test_terms_are_taken_while_one_stands_clear_of_noise() -> None:
    random = np.random.default_rng(5)
    offered = np.linalg.qr(random.standard_normal((500, 6)))[0]
    misfit = offered @ [10.0, 0.0, -8.0, 2.0, 0.0, 0.0] + 0.0
    assert sorted(_clear(misfit, np.zeros((500, 1)) + 1e-30, offered, [])) == [0, 2]  # 2 is no more than chance leaves
    assert sorted(_clear(misfit, offered[:, :1], offered, [])) == [2]  # what the fitted numbers may do is theirs


@dataclass(frozen=True)
class Felt(Driven):
    """A drive read with noise of a known deviation."""

    sigma: float = 0.0

    @property
    def input_noise(self) -> float:
        return self.sigma

    def redrawn(self, random: np.random.Generator) -> Felt:
        return replace(self, x=self.x + self.sigma * random.standard_normal(len(self.x)))


@dataclass(frozen=True)
class Steep(Linear):
    """A gain that is ten times as large where the drive is positive."""

    def predicted(self, parts: Sequence[Any], data: Driven) -> Array:
        return super().predicted(parts, data) * np.where(data.x > 0, 10.0, 1.0)


def test_where_nothing_is_known_of_the_input_every_sample_counts_alike() -> None:
    used = recordings(linear(), noisy([Gain()], 6))
    assert np.all(weighted(used, fit(used, [Gain()]), np.random.default_rng(7)).weights[0] == 1)


def test_a_sample_counts_less_where_noise_on_the_input_reaches_the_output_more() -> None:
    """1 / sqrt(1 + (g s / sigma)^2) with g the local slope, s the input's noise; 12 draws tell g s to 1 / sqrt(24), and a tenth
    of a second averages it."""
    x = np.repeat([2.0, -2.0] * 3, SAMPLES // 6)
    clean = 2 * x * np.where(x > 0, 10.0, 1.0)
    random = np.random.default_rng(8)
    data = Felt(DT, 0.0, True, x, clean + SIGMA * random.standard_normal(SAMPLES), 0.01)
    used = recordings(Steep("specimen:1", (Gain(),)), data)
    found = weighted(used, fit(used, [Gain()]), random)
    inside = np.arange(SAMPLES) % (SAMPLES // 6)
    away = (inside > 10) & (inside < SAMPLES // 6 - 10)  # of the jumps
    for where, slope in ((x > 0, 20.0), (x < 0, 2.0)):
        expected = 1 / np.sqrt(1 + (slope * 0.01 / SIGMA) ** 2)
        assert np.mean(found.weights[0][0][where & away]) == pytest.approx(expected, rel=0.05)
    assert found.steady[0] is found.weights[0]
