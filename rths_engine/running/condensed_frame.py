"""Exact condensation of a frame that yields, to its degrees of freedom with mass, load, station or base.

A yielding frame is its initial, linear frame under the forces of its plastic curvatures: r(x) = K x - G^T s kappa_p. Where
C = a1 K, D = b K and E = e K in the rows of the other degrees of freedom s, their equations need no solve:

x_s = T x_k + y, T = -inv(K_ss) K_sk;  each curvature G y follows its static value by the scheme of the loop, on its own.

So a step has m equations and Q curvatures instead of n equations and their members. See docs/decisions/0057.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.factor import factorised
from rths_engine.parts.structures.assembled import Members, no_members
from rths_engine.parts.structures.condensation import condensed
from rths_engine.parts.structures.frame_model import CURVATURE, WEIGHTS
from rths_engine.planning.model import Model
from rths_engine.running.equations import Equations, Following
from rths_engine.running.solve import solve_rows
from rths_engine.running.yield_points import YieldPoints

# chosen; see docs/decisions/0023
MOST_MEMBERS = 300  # more: the matrix of the points no longer fits into the caches
ROUNDED = 1e-11  # of the diagonal of K: a smaller difference from a multiple of K is rounding


def condensed_equations(model: Model) -> Equations | None:
    """The condensed equations of a frame; None for another structure and where the condensation would not be exact."""
    built, scheme = model.built, model.scheme
    if not 0 < len(built.members.dofs) <= MOST_MEMBERS:
        return None
    kept, rest = _parted(model)
    held = np.zeros_like(built.mass) if scheme.held is None else scheme.held
    shares = [_share(matrix, built.stiffness, rest) for matrix in (built.damping, scheme.effective, held)]
    if not len(rest) or np.isnan(shares).any() or shares[1] <= 0.0:
        return None
    at = np.ix_(kept, kept)
    stiffness = condensed(built.stiffness, kept)
    softer = stiffness - built.stiffness[at]
    damping, effective, kept_share = shares
    points, following = _points(built.members, built.stiffness, kept, rest)
    return Equations(
        kept,
        factorised(scheme.effective[at] + effective * softer),
        None if scheme.held is None else scheme.held[at] + kept_share * softer,
        built.damping[at] + damping * softer,
        stiffness,
        np.ascontiguousarray(model.loads[:, kept]),
        np.ascontiguousarray(model.drifts[:, kept]),
        no_members(),
        points._replace(damping=damping, effective=effective, held=kept_share),
        following,
    )


def _parted(model: Model) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Degrees of freedom with mass, load, station, floor or base, and the others."""
    built = model.built
    loaded = np.vstack([built.mass, model.loads, model.drifts]).any(axis=0)
    floors = [*built.floors, *([built.base] if built.base >= 0 else [])]
    kept = np.union1d(np.flatnonzero(loaded), floors).astype(np.int64)
    return kept, np.setdiff1d(np.arange(len(built.mass)), kept)


def _share(matrix: Array, stiffness: Array, rest: NDArray[np.int64]) -> float:
    """The factor c of matrix = c K in the rows `rest`; nan where the matrix is not a multiple of K there."""
    diagonal = np.diagonal(stiffness)
    share = float(np.mean(np.diagonal(matrix)[rest] / diagonal[rest])) if len(rest) else 0.0
    scale = np.sqrt(np.abs(np.outer(diagonal[rest], diagonal)))
    apart = np.abs(matrix[rest] - share * stiffness[rest])
    return share if (apart <= ROUNDED * abs(share) * scale).all() else float("nan")


def _points(
    members: Members, stiffness: Array, kept: NDArray[np.int64], rest: NDArray[np.int64]
) -> tuple[YieldPoints, Following]:
    """The points of the members that can yield, and how they follow; the factors of C, D and E are left at zero."""
    rows, section = _curvatures(members, len(stiffness))
    length, _, bending, moment, hardening = section.T
    weight = np.tile(WEIGHTS, len(rows) // len(WEIGHTS)) * length * bending**2 / (bending + hardening)
    others = rows[:, rest]
    right = np.vstack([-stiffness[np.ix_(kept, rest)], others])
    solved = np.empty_like(right)
    solve_rows(factorised(stiffness[np.ix_(rest, rest)]), right, np.empty(len(rest)), solved)  # BLAS' threads would cost more
    static, flexible = solved[: len(kept)].T, solved[len(kept) :]
    sparse = csr_array(others)
    own = rows[:, kept] + sparse @ static
    return (
        YieldPoints(
            curvature=np.ascontiguousarray(own.T),
            pushed=weight[:, None] * own,
            bent=np.ascontiguousarray(weight[:, None] * (sparse @ flexible.T).T),  # one layout, one compiled loop
            limit=moment / bending,
            damping=0.0,
            effective=0.0,
            held=0.0,
        ),
        Following(rest, static, others, flexible),
    )


def _curvatures(members: Members, count: int) -> tuple[Array, Array]:
    """Rows (Q, n) that map displacements to the curvature at each point that can yield, and the sections (Q, 5) there."""
    rows: Array = np.zeros((len(members.dofs), len(WEIGHTS), count))
    for row, dofs, shape, section in zip(rows, members.dofs, members.shape, members.section, strict=True):
        free = dofs >= 0
        at_ends = CURVATURE @ shape[1:] / section[0]
        np.add.at(row.T, dofs[free], at_ends[:, free].T)  # both ends of a beam share a lateral degree of freedom
    can_yield = np.isfinite(members.section[:, 3])
    return rows[can_yield].reshape(-1, count), np.repeat(members.section[can_yield], len(WEIGHTS), axis=0)
