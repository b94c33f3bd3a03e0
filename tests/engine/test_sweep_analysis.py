"""Fragility curves and sensitivities of results, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import log_ndtr, ndtr

from rths_engine.sweeps.fragility import fragility
from rths_engine.sweeps.sensitivity import bars


def drawn(median: float, dispersion: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Intensities, and whether each exceeds, of a known curve."""
    random = np.random.Generator(np.random.PCG64(7))
    x = np.exp(random.uniform(np.log(median / 4), np.log(median * 4), count))
    return x, random.uniform(size=count) < ndtr(np.log(x / median) / dispersion)


def test_the_curve_of_many_points_is_the_one_they_were_drawn_from() -> None:
    x, exceeds = drawn(0.6, 0.4, 20_000)
    found = fragility(x, exceeds)
    assert found.median == pytest.approx(0.6, rel=0.02)  # four standard errors of 20 000 points
    assert found.dispersion == pytest.approx(0.4, rel=0.05)
    assert len(found.empirical) == 10 and sum(one.points for one in found.empirical) == 20_000
    assert np.all(np.diff(found.probabilities) > 0)


def test_the_likelihood_is_largest_at_the_fit() -> None:
    x, exceeds = drawn(0.6, 0.4, 60)
    found = fragility(x, exceeds)
    assert found.median is not None and found.dispersion is not None

    def likelihood(median: float, dispersion: float) -> float:
        return float(np.sum(log_ndtr(np.where(exceeds, 1, -1) * np.log(x / median) / dispersion)))

    best = likelihood(found.median, found.dispersion)
    for by in (0.98, 1.02):
        assert likelihood(found.median * by, found.dispersion) < best
        assert likelihood(found.median, found.dispersion * by) < best


@pytest.mark.parametrize(
    ("exceeds", "why"),
    [
        ([False, False, False, False], "No point exceeds"),
        ([True, True, True, True], "Every point exceeds"),
        ([False, False, True, True], "the dispersion is too small"),
        ([True, True, False, False], "does not grow with the intensity"),
    ],
)
def test_points_without_a_curve_say_why(exceeds: list[bool], why: str) -> None:
    found = fragility(np.array([0.1, 0.2, 0.4, 0.8]), np.array(exceeds))
    assert found.median is None and why in found.reason
    assert [one.points for one in found.empirical] == [1, 1, 1, 1]


def test_levels_are_shown_as_they_are() -> None:
    found = fragility(np.repeat([0.2, 0.4, 0.8], 10), np.array(([False] * 9 + [True]) + [True, False] * 5 + [True] * 10))
    assert [(one.intensity, one.exceeding) for one in found.empirical] == [(0.2, 1), (0.4, 5), (0.8, 10)]


def test_the_longest_bar_is_of_the_input_with_the_largest_effect() -> None:
    first, second = (grid.ravel() for grid in np.meshgrid([1.0, 2.0, 3.0], [10.0, 20.0], indexing="ij"))
    measure = 5 * first - 0.1 * second
    small, large = bars(np.column_stack([first, second]), measure)[::-1]
    assert large.place == 0 and large.high - large.low == pytest.approx(10)
    assert small.place == 1 and small.high - small.low == pytest.approx(-1)
    assert large.correlation == pytest.approx(0.956, abs=0.01) and small.correlation is not None and small.correlation < 0
    assert (large.low_input, large.high_input) == (1, 3)


def test_many_values_are_compared_in_thirds_and_unknown_measures_are_left_out() -> None:
    x = np.linspace(0, 1, 91)
    measure = np.where(x > 0.95, np.nan, 2 * x)
    (bar,) = bars(x[:, None], measure)
    known = x[np.isfinite(measure)]
    assert bar.low == pytest.approx(2 * known[known <= np.quantile(known, 1 / 3)].mean())


def test_one_field_at_a_time_uses_the_points_of_its_own_field() -> None:
    inputs = np.array([[1.0, 5.0], [0.5, 5.0], [2.0, 5.0], [1.0, 4.0], [1.0, 9.0]])
    measure = inputs[:, 0] * 10 + inputs[:, 1]
    first, second = bars(inputs, measure, planned=[1.0, 5.0])
    assert (first.low, first.high) == (10.0, 25.0)
    assert (second.low, second.high) == (14.0, 19.0)
