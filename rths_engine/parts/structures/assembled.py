"""An assembled structure, as the loop uses it: matrices, influence vector, floors, storey drifts and inelastic members."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array


class Members(NamedTuple):
    """Inelastic beam-columns as tables for E members. Each has three basic deformations: elongation and two end rotations.

    dofs (E, 6) with -1 where supported; shape (E, 3, 6) maps end displacements to basic deformations; section (E, 5):
    length L (m), EA (N), EI (N m^2), yield moment (N m), plastic modulus H = b EI / (1 - b) (N m^2).
    """

    dofs: NDArray[np.int64]
    shape: Array
    section: Array


class Assembled(NamedTuple):
    """A structure of n degrees of freedom. K is the initial stiffness of all parts; `elastic` is K without the members."""

    mass: Array  # M (n, n), kg
    damping: Array  # C (n, n), N s/m
    stiffness: Array  # K (n, n), N/m
    elastic: Array  # (n, n), N/m
    influence: Array  # iota (n): displacement of each DOF by a unit ground displacement
    floors: tuple[int, ...]  # DOF of each floor's lateral displacement
    drifts: Array  # (storeys, n): row s maps x to the stroke of a damper in storey s + 1
    members: Members
    base: int = -1  # DOF of the base's lateral displacement; -1 where the base is the ground


def no_members() -> Members:
    """Empty tables, for a structure that is not a frame."""
    return Members(np.zeros((0, 6), dtype=np.int64), np.zeros((0, 3, 6)), np.zeros((0, 5)))
