"""Weights of models from their held-out log scores on blocks."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
DRAWS = 400


def stacked(scores: Array) -> Array:
    """Weights (M) of models from log scores (blocks, M): pseudo-BMA+ with a Bayesian bootstrap over the blocks.

    w_m = mean over draws of exp(z_m) / sum exp(z), z_m = B sum_b a_b s_bm, a ~ Dirichlet(1, ..., 1).

    Source: Yao, Vehtari, Simpson and Gelman (2018), Bayesian Analysis 13, 917-1007, section 3.4.
    """
    blocks = len(scores)
    shares = np.random.default_rng(0).dirichlet(np.ones(blocks), DRAWS)
    sums = blocks * shares @ scores
    weights = np.exp(sums - sums.max(axis=1, keepdims=True))
    found: Array = (weights / weights.sum(axis=1, keepdims=True)).mean(axis=0)
    return found
