"""The formula of what remains: known terms come back with their sizes, and held-out data confirm each of them."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.fitting import evaluated, fit
from rths_engine.diagnosis.unknown import LEAST_SHARE, Law, law
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import SIGMA, Driven, Gain, drive, driven, linear, recordings

X = drive()
OTHER = 1.5 * drive(1800)[::-1]  # another motion, half as large again
TOP = np.max(np.abs(X))


def recorded(x: Array, extra: Array, seed: int) -> Driven:
    return driven(2 * x + extra + SIGMA * np.random.default_rng(seed).standard_normal(len(x)), x)


def remains(*weights: tuple[float, int], heldout: tuple[tuple[float, int], ...] | None = None, seed: int = 1) -> Law | None:
    """The law of a residual of powers of the drive beside a fitted gain; `heldout` are the powers of the held-out motion."""
    powers = (weights, weights if heldout is None else heldout)
    pair = [
        recorded(x, sum((w * (x / TOP) ** power for w, power in given), np.zeros(len(x))), seed + place)
        for place, (x, given) in enumerate(zip((X, OTHER), powers, strict=True))
    ]
    used = recordings(linear(), pair[0])
    return law(used, fit(used, [Gain()]), (pair[1],))


@pytest.mark.parametrize(("size", "power"), [(2.0, 2), (-3.0, 3), (1.5, 5)])
def test_a_law_of_one_term_is_found_with_its_size_and_holds_at_another_amplitude(size: float, power: int) -> None:
    """The deviation of a weight is sigma over the length of its column beyond the gain, 1 to 3 here; five of it at most."""
    found = remains((size, power))
    assert found is not None and [term.formula for term in found.terms] == [f"x^{power}"]
    column = (X / TOP) ** power - X * (X @ (X / TOP) ** power) / (X @ X)
    assert found.terms[0].coefficient == pytest.approx(size, abs=5 * SIGMA / float(np.linalg.norm(column)))
    assert found.share > 0.95 and found.held_out_share > 0.95


def test_two_terms_are_found_and_the_fitted_gain_moves_with_them() -> None:
    """x^3 is mostly a gain on the fitted motion: only a gain that moves with the term predicts the larger motion."""
    found = remains((2.0, 2), (-3.0, 3))
    assert found is not None and {term.formula for term in found.terms} == {"x^2", "x^3"}
    assert all(f"the law {term.formula}" in found.words for term in found.terms)
    assert found.held_out_share > 0.95


def test_a_term_that_explains_less_than_a_twentieth_more_is_left_out() -> None:
    found = remains((3.0, 2), (0.05, 3))
    assert found is not None and [term.formula for term in found.terms] == ["x^2"]
    assert found.share > 1 - LEAST_SHARE


def test_a_term_that_held_out_data_contradict_is_no_law() -> None:
    assert remains((3.0, 2), heldout=((-3.0, 2),)) is None


def test_noise_has_no_law() -> None:
    assert not [seed for seed in range(20) if remains(seed=3 * seed) is not None]


def test_a_residual_of_nothing_has_no_law() -> None:
    used = recordings(linear(), driven(2 * X))
    assert law(used, evaluated(used, [Gain(gain=2.0)]), (driven(2 * OTHER, OTHER),)) is None
