"""Sparse factorisation of a symmetric positive definite matrix."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError

# chosen; see docs/decisions/0023
LOST = 1e-13  # a pivot this small relative to its diagonal entry is rounding error: the matrix is singular


class Factor(NamedTuple):
    """P A P^T = L D L^T of a symmetric positive definite matrix; L in compressed columns, without its unit diagonal.

    The time of a solve is proportional to the number of entries in L. For frames that is about proportional to the number of
    degrees of freedom. It is slow when every equation is coupled to all others: L is then half of a dense matrix.
    """

    order: Any  # P: equation order[k] is eliminated as number k
    start: Any
    row: Any
    value: Any
    pivot_inverse: Any  # 1 / D


def factorised(matrix: Array) -> Factor:
    """The factor of the symmetric `matrix` (n, n) in minimum-degree order. Raises PlanError unless it is positive definite."""
    diagonal = np.diagonal(matrix)
    if not np.isfinite(matrix).all() or not (diagonal > 0).all():
        raise PlanError(_SINGULAR)
    try:
        split = splu(
            csc_array(matrix),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True, "Equil": False},
        )
    except RuntimeError:
        raise PlanError(_SINGULAR) from None
    order = np.argsort(split.perm_c).astype(np.uint64)
    pivots = split.U.diagonal()
    if not np.array_equal(split.perm_r, split.perm_c) or not (pivots > LOST * diagonal[order]).all():
        raise PlanError(_SINGULAR)
    lower = csc_array(split.L)
    lower.setdiag(0.0)
    lower.eliminate_zeros()
    lower.sort_indices()
    return Factor(order, lower.indptr.astype(np.uint64), lower.indices.astype(np.uint64), lower.data, 1 / pivots)


_SINGULAR = Issue(
    "structure",
    "M + dt/2 C + dt^2/4 K is singular",
    fix="give every degree of freedom mass, damping or stiffness",
)
