"""The sparse solve against dense algebra, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.factor import factorised
from rths_engine.running.solve import solve


def coupled(seed: int, size: int) -> np.ndarray:
    """A random symmetric positive definite matrix with some five entries a row."""
    random = np.random.default_rng(seed)
    half = random.normal(size=(size, size)) * (random.random((size, size)) < 3 / size)
    return half @ half.T + np.diag(random.uniform(0.5, 2.0, size))


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(1, 60))
def test_the_solve_agrees_with_dense_algebra(seed: int, size: int) -> None:
    matrix, right = coupled(seed, size), np.random.default_rng(seed + 1).normal(size=size)
    result = np.empty(size)
    solve(factorised(matrix), right, np.empty(size), result)
    assert matrix @ result == pytest.approx(right, rel=1e-9, abs=1e-10 * np.abs(right).max())  # condition below 1e4


@pytest.mark.parametrize(
    "matrix",
    [
        np.zeros((2, 2)),
        np.array([[1.0, -1.0], [-1.0, 1.0]]),  # a free body
        np.array([[1.0, 2.0], [2.0, 1.0]]),  # indefinite
        np.array([[1.0, np.nan], [np.nan, 1.0]]),
    ],
)
def test_a_matrix_that_is_not_positive_definite_is_refused(matrix: np.ndarray) -> None:
    with pytest.raises(PlanError, match="singular"):
        factorised(matrix)
