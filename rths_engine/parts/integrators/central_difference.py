"""Central difference integration."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.foundation.arrays import Array
from rths_engine.parts.integrators.scheme import Scheme
from rths_engine.parts.integrators.stepping import Stepping


class CentralDifference(Stepping):
    """Central difference integration.

    M (x[i+1] - 2 x[i] + x[i-1]) / dt^2 + C (x[i+1] - x[i-1]) / (2 dt) + r[i] = F[i]

    With w[i] = (x[i+1] - x[i]) / dt: (M + dt/2 C) (w[i] - w[i-1]) / dt = F[i] - C w[i-1] - r[i]. The displacements equal those
    of explicit Newmark except for rounding; laboratories use both names. Second order; stable while omega dt <= 2 in every
    mode, so every degree of freedom needs mass.
    Source: Takanashi et al. (1975), Bull. Earthquake Resistant Structure Research Center 8; Chopra, section 5.3.
    """

    kind: Literal["central_difference"] = "central_difference"
    title: ClassVar[str] = "Central difference"
    stable_up_to: ClassVar[float] = 2.0

    def build(self, mass: Array, damping: Array, stiffness: Array) -> Scheme:
        return Scheme(mass + self.dt / 2 * damping)
