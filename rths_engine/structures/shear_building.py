"""Shear building: rigid floors, one lateral spring a storey."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import Field
from scipy.linalg import eigh

from rths_engine.arrays import Array
from rths_engine.errors import Issue, PlanError
from rths_engine.part import Value, quantity


class Storey(Value):
    """One storey: the floor's mass on top of a lateral spring."""

    mass: float = quantity("Floor mass", "kg", "t", gt=0, le=1e9)
    stiffness: float = quantity("Storey stiffness", "N/m", "kN/m", gt=0, le=1e13)
    height: float = quantity("Storey height", "m", gt=0, le=50, default=3.0)


class ShearBuilding(Value):
    """M a + C v + K x = F:  M = diag(m_j);  K tridiagonal, k_j between floors j-1 and j;  C = a0 M + a1 K (Rayleigh).

    a0 and a1 give `damping_ratio` in the first two modes (in the only mode for one storey). x: floors relative to
    the ground (m), n = number of storeys. Fails first when beams are flexible, members yield or P-delta matters.
    Source: Chopra, Dynamics of Structures, chapters 9 and 11.
    """

    kind: Literal["shear_building"] = "shear_building"
    storeys: tuple[Storey, ...] = Field(title="Storeys", min_length=1, max_length=100)
    damping_ratio: float = quantity("Damping ratio of modes 1 and 2", shown="%", ge=0, lt=1, default=0.02)
    title: ClassVar[str] = "Shear building"

    def matrices(self) -> tuple[Array, Array, Array]:
        """M (kg), C (N s/m), K (N/m), each n x n. Raises PlanError when the modes can't be found."""
        mass = np.diag([storey.mass for storey in self.storeys])
        stiffness = np.zeros_like(mass)
        for floor, storey in enumerate(self.storeys):
            drift = self.drift(floor + 1)
            stiffness += storey.stiffness * np.outer(drift, drift)
        return mass, self._rayleigh(mass, stiffness), stiffness

    def drift(self, storey: int) -> Array:
        """Row L with L @ x = drift of `storey` (from 1)."""
        row = np.zeros(len(self.storeys))
        row[storey - 1] = 1.0
        if storey > 1:
            row[storey - 2] = -1.0
        return row

    def frequencies(self) -> Array:
        """Undamped circular frequencies (rad/s), rising."""
        mass, _, stiffness = self.matrices()
        return _frequencies(mass, stiffness)

    def periods(self) -> Array:
        """Natural periods (s), the first mode's first."""
        periods: Array = 2 * np.pi / self.frequencies()
        return periods

    def _rayleigh(self, mass: Array, stiffness: Array) -> Array:
        omega = _frequencies(mass, stiffness)
        if len(omega) == 1:
            return np.asarray(2 * self.damping_ratio * omega[0] * mass)
        first, second = omega[:2]
        a0 = 2 * self.damping_ratio * first * second / (first + second)
        a1 = 2 * self.damping_ratio / (first + second)
        rayleigh: Array = a0 * mass + a1 * stiffness
        return rayleigh


def _frequencies(mass: Array, stiffness: Array) -> Array:
    squares = eigh(stiffness, mass, eigvals_only=True)
    if squares[0] <= 1e-12 * squares[-1]:
        raise PlanError(
            Issue(
                "structure",
                "the stiffness matrix is singular: the structure is a mechanism",
                fix="raise the softest storey's stiffness",
            )
        )
    omega: Array = np.sqrt(squares)
    return omega
