"""Damping that grows with the square of the velocity."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import TINY, Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class QuadraticDamping(OfStorey):
    """Damping that grows with the square of the velocity.

    f = c_2 |v| v

    v is the velocity of the storey's drift, c_2 (N s^2/m^2) the coefficient. Neutral: c_2 = 0. No state. A cycle of a sine of
    amplitude X dissipates 8/3 c_2 omega^2 X^3. Source: Chopra, Dynamics of Structures, chapter 3, equivalent viscous damping.
    Not valid where the damping does not come from a turbulent flow.
    """

    kind: Literal["quadratic_damping"] = "quadratic_damping"
    coefficient: float = quantity("Quadratic damping c₂", "N*(s/m)^2", "kN*(s/m)^2", ge=0, le=1e12, default=0.0)
    title: ClassVar[str] = "Quadratic damping"
    neutral: ClassVar = {"coefficient": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.coefficient]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * abs(v) * v


class QuadraticDampingSearch(StoreySearch[QuadraticDamping]):
    relatives = ("damping_error", "coulomb_friction")
    noun = "quadratic damping"

    def guesses(self, seen: Seen) -> Iterator[QuadraticDamping]:
        coefficient = 0.02 * seen.f / max(seen.v * seen.v, TINY)
        yield self.sized(coefficient=coefficient).model_copy(update={"storey": seen.storey})

    def says(self, effect: QuadraticDamping) -> str:
        return f"has a damping force of {said(effect.coefficient, 'kN*(s/m)^2')} times the square of its velocity"
