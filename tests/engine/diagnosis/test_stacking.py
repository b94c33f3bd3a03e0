"""Weights of models from held-out log scores."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.stacking import stacked


def test_equal_scores_get_equal_weights_that_sum_to_one() -> None:
    assert stacked(np.zeros((5, 4))) == pytest.approx([0.25] * 4)


def test_a_gain_in_every_block_is_certain_and_a_gain_in_one_of_two_is_not() -> None:
    every = np.column_stack([np.full(8, 5.0), np.zeros(8)])
    assert stacked(every)[0] > 0.999
    split = np.column_stack([[6.0, -6.0], [0.0, 0.0]])
    assert 0.35 < stacked(split)[0] < 0.65  # the softmax of the sum, 0, and of either block alone
