"""Restoring forces of a structure, compiled: sparse products and bilinear beam-columns."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import piece
from rths_engine.parts.structures.frame_model import CURVATURE, WEIGHTS


class Rows(NamedTuple):
    """A matrix in compressed rows."""

    start: Any
    column: Any
    value: Any


def rows(matrix: Array) -> Rows:
    """The matrix in compressed rows, without its zeros."""
    sparse = csr_array(matrix)
    return Rows(sparse.indptr.astype(np.uint64), sparse.indices.astype(np.uint64), sparse.data)


@piece
def subtract_product(matrix, vector, result):
    """Subtract a product: result -= matrix @ vector."""
    for a in range(result.size):
        total = 0.0
        for entry in range(matrix.start[a], matrix.start[a + 1]):
            total += matrix.value[entry] * vector[matrix.column[entry]]
        result[a] -= total


@piece
def subtract_forces(members, x, plastic, result):
    """Subtract the members' restoring forces: result -= r(x).

    `plastic` (E, 3) are the plastic curvatures (1/m) of the members, updated in place.

    At each Lobatto point the trial moment is EI (kappa - kappa_p) and the back moment H kappa_p. Where they differ by more than
    the yield moment, kappa_p increases by the excess over EI + H (bilinear law, kinematic hardening, exact return mapping).
    """
    for e in range(members.dofs.shape[0]):
        dofs, shape = members.dofs[e], members.shape[e]
        length, axial, bending = members.section[e, 0], members.section[e, 1], members.section[e, 2]
        yield_moment, hardening = members.section[e, 3], members.section[e, 4]
        elongation, turned, turned_end = 0.0, 0.0, 0.0
        for end in range(6):
            if dofs[end] >= 0:
                moved = x[dofs[end]]
                elongation += shape[0, end] * moved
                turned += shape[1, end] * moved
                turned_end += shape[2, end] * moved
        start, finish = 0.0, 0.0
        for point in range(3):
            curvature = (CURVATURE[point, 0] * turned + CURVATURE[point, 1] * turned_end) / length
            moment = bending * (curvature - plastic[e, point])
            excess = abs(moment - hardening * plastic[e, point]) - yield_moment
            if excess > 0.0:
                flow = excess / (bending + hardening)
                if moment - hardening * plastic[e, point] < 0.0:
                    flow = -flow
                plastic[e, point] += flow
                moment -= bending * flow
            start += WEIGHTS[point] * CURVATURE[point, 0] * moment
            finish += WEIGHTS[point] * CURVATURE[point, 1] * moment
        force = axial / length * elongation
        for end in range(6):
            if dofs[end] >= 0:
                result[dofs[end]] -= shape[0, end] * force + shape[1, end] * start + shape[2, end] * finish
