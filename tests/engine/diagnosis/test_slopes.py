"""The Jacobian of a misfit by differences and by secants."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.slopes import DIFFERENCE, KEPT, Slopes, differences
from rths_engine.foundation.arrays import Array

MATRIX = np.array([[1.0, 2.0], [-3.0, 0.5], [0.2, 4.0]])
WIDE = np.array([[-1e3, 1e3], [-1e3, 1e3]])


def curved(z: Array) -> Array:
    return np.array([z[0] ** 2, z[0] * z[1], np.sin(z[1])])


def slopes_of_curved(z: Array) -> Array:
    return np.array([[2 * z[0], 0.0], [z[1], z[0]], [0.0, np.cos(z[1])]])


def test_the_slopes_of_a_linear_misfit_are_its_matrix() -> None:
    z = np.array([0.4, -20.0])
    found = differences(lambda z: MATRIX @ z, z, MATRIX @ z, WIDE)
    assert found == pytest.approx(MATRIX, rel=1e-10)  # rounding 1e-16 of 80 over a step of 1e-3


def test_a_difference_errs_by_half_its_step_times_the_curvature() -> None:
    z = np.array([1.5, 0.7])
    found = differences(curved, z, curved(z), WIDE)
    steps = DIFFERENCE * np.array([1.5, 1.0])  # of a number's size, and no less than of 1
    second = np.array([[2.0, 0.0], [0.0, 0.0], [0.0, -np.sin(0.7)]])
    assert found - slopes_of_curved(z) == pytest.approx(second * steps / 2, abs=1e-6)  # third order: step^2 / 6 < 1e-6


def test_at_an_upper_bound_the_difference_is_taken_backward() -> None:
    asked: list[Array] = []

    def misfit(z: Array) -> Array:
        asked.append(z)
        return MATRIX @ z

    bounds = np.array([[-1.0, 1.0], [-1.0, 1.0]])
    z = np.array([1.0, 0.0])
    assert differences(misfit, z, MATRIX @ z, bounds) == pytest.approx(MATRIX, rel=1e-9)
    assert all((bounds[:, 0] <= one).all() and (one <= bounds[:, 1]).all() for one in asked)


def test_no_number_has_no_slopes() -> None:
    assert differences(lambda z: np.zeros(4), np.zeros(0), np.zeros(4), np.zeros((0, 2))).shape == (4, 0)


def test_a_secant_is_exact_along_the_step_and_leaves_what_is_across_as_it_was() -> None:
    """Broyden (1965): J+ step = f(z+) - f(z), and J+ w = J w for w orthogonal to the step."""
    slopes = Slopes(curved, WIDE)
    first, second = np.array([1.0, 0.5]), np.array([1.2, 0.9])
    before, after = slopes.jacobian(first), slopes.jacobian(second)
    step = second - first
    across = np.array([-step[1], step[0]])
    assert after @ step == pytest.approx(curved(second) - curved(first), abs=1e-12)
    assert after @ across == pytest.approx(before @ across, abs=1e-12)


def test_differences_are_taken_again_after_two_secants() -> None:
    calls = 0

    def misfit(z: Array) -> Array:
        nonlocal calls
        calls += 1
        return curved(z)

    slopes = Slopes(misfit, WIDE)
    counts = []
    for place in range(2 * (KEPT + 1)):
        before = calls
        slopes.jacobian(np.array([1.0 + 0.1 * place, 0.5]))
        counts.append(calls - before)
    assert counts == [3, 1, 1, 3, 1, 1]  # the misfit itself, and beside it one for each of two numbers


def test_a_misfit_asked_for_just_before_is_not_computed_again() -> None:
    calls: list[Array] = []

    def misfit(z: Array) -> Array:
        calls.append(z)
        return curved(z)

    slopes = Slopes(misfit, WIDE)
    z = np.array([1.0, 0.5])
    slopes.misfit(z)
    slopes.jacobian(z)
    assert len(calls) == 3
