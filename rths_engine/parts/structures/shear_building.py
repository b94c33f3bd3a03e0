"""Shear building: rigid floors and one lateral spring in each storey."""

from __future__ import annotations

from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from rths_engine.foundation.part import Value, quantity
from rths_engine.parts.structures.assembled import Assembled, no_members
from rths_engine.parts.structures.modes import circular_frequencies, rayleigh


class Storey(Value):
    """One storey: a lateral spring and the mass of the floor above it."""

    mass: float = quantity("Floor mass", "kg", "t", gt=0, le=1e9)
    stiffness: float = quantity("Storey stiffness", "N/m", "kN/m", gt=0, le=1e13)
    height: float = quantity("Storey height", "m", gt=0, le=50, default=3.0)


class ShearBuilding(Value):
    """Shear building: rigid floors and one lateral spring in each storey.

    M a + C v + K x = F:  M = diag(m_j);  K tridiagonal, k_j between floors j-1 and j;  C = a0 M + a1 K (Rayleigh)

    a0 and a1 give `damping_ratio` in the first two modes, or in the only mode of a building with one storey. x (m) are the
    displacements of the floors relative to the ground.
    Not valid when beams are flexible, members yield or the P-delta effect matters.
    Source: Chopra, Dynamics of Structures, chapters 9 and 11.
    """

    kind: Literal["shear_building"] = "shear_building"
    storeys: tuple[Storey, ...] = Field(title="Storeys", min_length=1, max_length=100)
    damping_ratio: float = quantity("Damping ratio of modes 1 and 2", shown="%", ge=0, lt=1, default=0.02)
    title: ClassVar[str] = "Shear building"

    def assemble(self) -> Assembled:
        """The matrices of the building. Raises PlanError for a mechanism."""
        return _assembled(self)


@lru_cache(maxsize=8)
def _assembled(building: ShearBuilding) -> Assembled:
    count = len(building.storeys)
    mass = np.diag([storey.mass for storey in building.storeys])
    drifts = np.eye(count) - np.eye(count, k=-1)
    stiffness = drifts.T @ np.diag([storey.stiffness for storey in building.storeys]) @ drifts
    damping = rayleigh(mass, stiffness, building.damping_ratio, circular_frequencies(mass, stiffness))
    return Assembled(mass, damping, stiffness, stiffness, np.ones(count), tuple(range(count)), drifts, no_members())
