"""Natural frequencies and Rayleigh damping of a structure whose mass matrix may be singular."""

from __future__ import annotations

import numpy as np
from scipy.linalg import LinAlgError, eigh

from rths_engine.arrays import Array
from rths_engine.errors import Issue, PlanError

MECHANISM = Issue(
    "structure",
    "the stiffness matrix is singular: the structure is a mechanism",
    fix="support it or raise its softest stiffness",
)


def circular_frequencies(mass: Array, stiffness: Array) -> Array:
    """omega (rad/s), rising, of K phi = omega^2 M phi; massless DOF give none. PlanError for a mechanism."""
    try:
        inverses = eigh(mass, stiffness, eigvals_only=True)[::-1]
    except LinAlgError:
        raise PlanError(MECHANISM) from None
    inverses = inverses[inverses > 1e-12 * inverses[0]]
    if not len(inverses) or not np.isfinite(inverses).all() or np.linalg.cond(stiffness) > 1e14:
        raise PlanError(MECHANISM)
    omega: Array = 1 / np.sqrt(inverses)
    return omega


def rayleigh(mass: Array, stiffness: Array, ratio: float, omega: Array) -> Array:
    """C = a0 M + a1 K with `ratio` in the first two modes; C = a0 M for a single mode. Source: Chopra, chapter 11."""
    if len(omega) == 1:
        return np.asarray(2 * ratio * omega[0] * mass)
    first, second = omega[:2]
    return np.asarray(2 * ratio / (first + second) * (first * second * mass + stiffness))
