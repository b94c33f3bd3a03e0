"""Natural frequencies and Rayleigh damping of a structure whose mass matrix may be singular."""

from __future__ import annotations

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, cholesky, eigvalsh

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError

# chosen; see docs/decisions/0023
PROBLEM = "its stiffness matrix is singular: it is a mechanism"
MECHANISM = Issue("structure", PROBLEM, fix="support it or raise its softest stiffness")
DEPENDENT = Issue(
    "structure.mass", "the mass matrix is singular", fix="give each degree of freedom its own mass, or no mass at all"
)
WEIGHTLESS = Issue(
    "structure", "a degree of freedom has almost no mass relative to the others", fix="give it more mass, or no mass at all"
)
LOST = 1e-13  # a pivot this small relative to its diagonal entry is rounding error: the matrix is singular


def circular_frequencies(mass: Array, stiffness: Array) -> Array:
    """Circular frequencies omega (rad/s), ascending, of K phi = omega^2 M phi; massless DOF have none.

    1/omega^2 are the eigenvalues of G^T F G, where F is the flexibility at the DOF that have mass and G G^T their mass matrix.
    Raises PlanError for a mechanism or for a mass that is almost zero.
    """
    massive = np.flatnonzero(mass.any(axis=0))
    try:
        root = cholesky(mass[np.ix_(massive, massive)], lower=True)
        if _lost(root, mass[massive, massive]):
            raise PlanError(DEPENDENT)
    except LinAlgError:
        raise PlanError(DEPENDENT) from None
    try:
        factor, lower = cho_factor(stiffness)
        if not len(massive) or _lost(factor, np.diagonal(stiffness)):
            raise PlanError(MECHANISM)
        flexibility = cho_solve((factor, lower), np.eye(len(mass))[:, massive])[massive]
        squares = eigvalsh(root.T @ flexibility @ root)  # 1 / omega^2, ascending
        if not squares[0] > 0:
            raise PlanError(WEIGHTLESS)
        omega: Array = 1 / np.sqrt(squares[::-1])
    except (LinAlgError, ValueError):
        raise PlanError(MECHANISM) from None
    return omega


def _lost(factor: Array, diagonal: Array) -> bool:
    """Whether a pivot of a Cholesky factor is rounding error, so that the matrix is singular."""
    return bool((np.diagonal(factor) ** 2 <= LOST * diagonal).any())


def rayleigh(mass: Array, stiffness: Array, ratio: float, omega: Array) -> Array:
    """C = a0 M + a1 K with `ratio` in the first two modes; C = a0 M for a single mode. Source: Chopra, chapter 11."""
    if len(omega) == 1:
        return np.asarray(2 * ratio * omega[0] * mass)
    first, second = omega[:2]
    return np.asarray(2 * ratio / (first + second) * (first * second * mass + stiffness))
