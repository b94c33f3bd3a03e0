"""Lambda beside a direct minimisation of the distance between two models."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.separate import APART, alike, separation
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import SHAPES, SIGMA, Gain, Wave, drive, driven, linear, noisy, recordings


def least_distance(target: Array, storey: int) -> float:
    """The least of |target - g x - c shape|^2 / sigma^2 over g and c, by a simplex search."""
    x = drive()
    shape = SHAPES[storey - 1](x)

    def distance(numbers: Array) -> float:
        off = target - numbers[0] * x - numbers[1] * shape
        return float(off @ off) / SIGMA**2

    found = minimize(distance, [1.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-10, "maxiter": 4000})
    return float(found.fun)


@pytest.mark.parametrize(("true", "rival"), [(1, 4), (3, 4), (2, 1)])
def test_lambda_is_the_least_distance_between_two_models_in_units_of_the_noise(true: int, rival: int) -> None:
    """On what one simulates without noise, fitted by the other."""
    x = drive()
    target = 2.1 * x + 0.3 * SHAPES[true - 1](x)
    used = recordings(linear(), driven(target))
    one, other = (fit(used, [Gain(), Wave(size=0.1, storey=storey)]) for storey in (true, rival))
    assert separation(used, one.parts, other.parts) == pytest.approx(least_distance(target, rival), rel=1e-4)


def test_a_model_is_no_distance_from_itself() -> None:
    used = recordings(linear(), noisy([Gain()], 1))
    assert separation(used, [Gain(gain=1.9)], [Gain(gain=1.9)]) == 0.0


def test_lambda_of_a_known_difference_counts_every_sample_and_recording() -> None:
    used = recordings(linear(), noisy([Gain()], 2), noisy([Gain()], 3))
    expected = 2 * np.sum((0.3 * drive()) ** 2) / SIGMA**2
    assert separation(used, [Gain(gain=2.0)], [Gain(gain=2.3)]) == pytest.approx(expected, rel=1e-12)


def test_models_are_alike_where_their_lambda_is_below_ten() -> None:
    """An effect of 0.002 leaves the distance between them below the noise, one of 0.5 does not."""
    for size, expected in ((0.002, True), (0.5, False)):
        used = recordings(linear(), noisy([Gain(), Wave(size=size, storey=1)], 4))
        fits = tuple(fit(used, [Gain(), Wave(size=0.1, storey=storey)]) for storey in (1, 4))
        best = min(fits, key=lambda one: one.bic)
        found = alike(used, best, fits)
        assert bool(found) is expected
        assert all(apart < APART and model is not best for model, apart in found)


def test_a_rival_that_is_likely_is_alike_whatever_its_distance() -> None:
    """Measured tests have errors beyond the noise: probabilities count them, lambda does not."""
    used = recordings(linear(), noisy([Gain(), Wave(size=0.5, storey=1)], 4))
    fits = tuple(fit(used, [Gain(), Wave(size=0.1, storey=storey)]) for storey in (1, 4))
    assert [model for model, _ in alike(used, fits[0], fits, (0.6, 0.4))] == [fits[1]]
    assert alike(used, fits[0], fits, (0.96, 0.04)) == []


def test_models_of_other_counts_of_effects_or_far_behind_are_no_rivals() -> None:
    used = recordings(linear(), noisy([Gain(), Wave(size=0.02, storey=1)], 5))
    best, plain, both = (fit(used, [Gain(), *(Wave(size=0.02, storey=one) for one in waves)]) for waves in ((1,), (), (1, 4)))
    assert alike(used, best, (best, plain, both)) == []
