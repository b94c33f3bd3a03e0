"""First-order actuator with velocity and force limits."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class FirstOrderDelay(Part):
    """First-order actuator with velocity and force limits.

    d_m[q] = d_m[q-1] + (d_p[q] - d_m[q-1]) / alpha   (5a)

    The increment is limited to velocity_limit * dt. While the specimen resists with force_limit or more, the piston stalls:
    it does not move against the force, but it can move with the force. The stall is one substep behind the force.
    alpha >= 1 (number); the delay is about (alpha - 1) controller steps. State: s[0] piston displacement (m).
    Not valid where the real delay grows with frequency or demand.
    Source: Chen and Ricles (2012), EESD 41, 549-569, equation (5a); the limits are those of the cylinders in section 4.
    """

    kind: Literal["first_order_delay"] = "first_order_delay"
    alpha: float = quantity("Delay constant α", ge=1, le=1000, default=30.0, help="the delay is (α − 1) controller steps")
    velocity_limit: float = quantity("Velocity limit", "m/s", "mm/s", gt=0, le=10, default=0.56)
    force_limit: float = quantity("Force capacity", "N", "kN", gt=0, le=1e8, default=2.3e6)
    title: ClassVar[str] = "First-order delay"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.alpha, self.velocity_limit * dt, self.force_limit]), np.zeros(1)

    @staticmethod
    def step(p, s, x_comp, force):
        move = (x_comp - s[0]) / p[0]
        if move > p[1]:
            move = p[1]
        elif move < -p[1]:
            move = -p[1]
        if (force >= p[2] and move > 0.0) or (force <= -p[2] and move < 0.0):
            move = 0.0
        s[0] += move
        return s[0]
