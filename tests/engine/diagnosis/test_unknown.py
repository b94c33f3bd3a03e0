"""The formula of what remains, where it is known."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rths_engine.diagnosis.fitting import evaluated, fit
from rths_engine.diagnosis.unknown import LEAST_SHARE, MOST_TERMS, law
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import SIGMA, Gain, drive, driven, linear, recordings

X = drive()
SCALED = X / np.max(np.abs(X))


def remains(extra: Array, seed: int = 1) -> tuple[dict[str, float], float]:
    """Terms with their weights, and the share, of a residual beside a fitted gain and noise."""
    used = recordings(linear(), driven(2 * X + extra + SIGMA * np.random.default_rng(seed).standard_normal(len(X))))
    found = law(used, fit(used, [Gain()]))
    assert found is not None
    terms = re.findall(r"([+-]?[\d.e-]+) (x\^?\d?)", found.formula)
    assert all(f"the law {name}" in found.words for _, name in terms)
    return {name: float(weight) for weight, name in terms}, found.share


@pytest.mark.parametrize(("size", "power"), [(2.0, 2), (-3.0, 3), (1.5, 5)])
def test_a_law_of_one_term_is_found_with_its_size(size: float, power: int) -> None:
    """The deviation of a weight is sigma over the length of its column beyond the gain, 1 to 3 here; five of it at most."""
    terms, share = remains(size * SCALED**power)
    assert list(terms) == [f"x^{power}"]
    column = SCALED**power - X * (X @ SCALED**power) / (X @ X)
    assert terms[f"x^{power}"] == pytest.approx(size, abs=5 * SIGMA / float(np.linalg.norm(column)) + 0.005)  # three digits
    assert share > 0.95


def test_two_terms_are_found_and_what_the_fitted_number_absorbs_is_no_term() -> None:
    terms, share = remains(2 * SCALED**2 - 3 * SCALED**3)
    assert set(terms) == {"x^2", "x^3"} and 0.95 < share <= 1.0
    assert terms["x^2"] == pytest.approx(2.0, rel=0.1) and terms["x^3"] == pytest.approx(-3.0, rel=0.1)


def test_a_term_that_explains_less_than_a_twentieth_more_is_left_out() -> None:
    terms, share = remains(3 * SCALED**2 + 0.05 * SCALED**3)
    assert list(terms) == ["x^2"] and len(terms) <= MOST_TERMS
    assert share > 1 - LEAST_SHARE


def test_a_residual_of_nothing_has_no_law() -> None:
    used = recordings(linear(), driven(2 * X))
    model = evaluated(used, [Gain(gain=2.0)])
    assert law(used, model) is None
