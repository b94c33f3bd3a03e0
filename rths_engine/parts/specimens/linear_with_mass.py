"""Linear spring and dashpot with a mass."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class LinearWithMass(Part):
    """Linear spring and dashpot with a mass: f = k x + c v + m a.

    v = (x[q] - x[q-1]) / dt and a = (x[q] - 2 x[q-1] + x[q-2]) / dt^2: the force that a load cell between the actuator and a
    frame measures, inertia included. The floor of the laboratory is at rest, so that a is relative to it: the ground motion
    acts on this mass in the analytical substructure. x (m), f (N). State: s[0], s[1] the last two displacements (m).
    Not valid with yielding, friction or slack, nor where x is noisy: a amplifies noise by 1 / dt^2.
    Source: Silva, Gomez, Maghareh, Dyke and Spencer (2020), Mech. Syst. Signal Process. 135, 106381.
    """

    kind: Literal["linear_with_mass"] = "linear_with_mass"
    stiffness: float = quantity("Stiffness k", "N/m", "kN/m", ge=0, le=1e12, default=1.19e6)
    damping: float = quantity("Damping coefficient c", "N*s/m", ge=0, le=1e12, default=114.22)
    mass: float = quantity("Mass m", "kg", ge=0, le=1e6, default=29.13)
    title: ClassVar[str] = "Linear spring and dashpot with mass"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness, self.damping / dt, self.mass / dt**2]), np.zeros(2)

    @staticmethod
    def step(p, s, x, dt):
        last, before = s[0], s[1]
        s[0], s[1] = x, last
        return p[0] * x + p[1] * (x - last) + p[2] * (x - 2.0 * last + before)
