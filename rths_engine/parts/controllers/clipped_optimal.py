"""Clipped-optimal control with stated gains."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.controllers.controller import Commanding


class ClippedOptimal(Commanding):
    """Clipped-optimal control with stated gains.

    i = i_max H((f_d - f) f),  f_d = g_d d + g_v v

    H is the unit step: H = 1 for a positive argument, else 0. The current is the largest current while the damper force f (N)
    has the sign of the desired force f_d (N) and is smaller; otherwise the current is zero. f is the measured force of the
    last substep. f_d is the force of a linear controller on the damper's own displacement d (m) and velocity v (m/s); its
    gains come from a design outside this program, such as LQR with static output feedback.
    Not valid where the design needs the motion of other storeys: this controller sees its own storey only.
    Source: Dyke, Spencer, Sain and Carlson (1996), "Modeling and control of magnetorheological dampers for seismic response
    reduction", Smart Mater. Struct. 5, 565-575.
    """

    kind: Literal["clipped_optimal"] = "clipped_optimal"
    displacement_gain: float = quantity("Gain on displacement g_d", "N/m", "kN/m", ge=-1e12, le=1e12, default=0.0)
    velocity_gain: float = quantity("Gain on velocity g_v", "N*s/m", "kN*s/m", ge=-1e12, le=1e12, default=1.0e6)
    largest_current: float = quantity("Largest current i_max", "A", gt=0, le=1000, default=2.5)
    title: ClassVar[str] = "Clipped-optimal"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.displacement_gain, self.velocity_gain, self.largest_current]), np.zeros(1)

    @property
    def range(self) -> tuple[float, float]:
        return 0.0, self.largest_current

    @staticmethod
    def step(p, s, d, v, f, dt):
        desired = p[0] * d + p[1] * v
        return p[2] if (desired - f) * f > 0.0 else 0.0
