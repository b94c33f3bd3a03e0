"""Linear spring and dashpot in parallel."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class LinearSpecimen(Part):
    """Linear spring and dashpot in parallel: f = k x + c v, with v the displacement increment over dt.

    x (m), f (N). State: s[0] last displacement (m). Not valid with yielding, friction or slack.
    """

    kind: Literal["linear"] = "linear"
    stiffness: float = quantity("Stiffness", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    damping: float = quantity("Damping coefficient", "N*s/m", "kN*s/m", ge=0, le=1e12, default=5.0e5)
    title: ClassVar[str] = "Linear spring and dashpot"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness, self.damping]), np.zeros(1)

    @staticmethod
    def step(p, s, x, dt):
        v = (x - s[0]) / dt
        s[0] = x
        return p[0] * x + p[1] * v
