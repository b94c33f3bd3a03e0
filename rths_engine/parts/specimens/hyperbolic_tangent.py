"""Hyperbolic tangent model of a controllable-fluid damper."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class HyperbolicTangent(Part):
    """Hyperbolic tangent model of a controllable-fluid damper.

    f = k x + c v + f_0 tanh(v / v_0 + x / x_0),  v the displacement increment over dt

    f_0 is the yield force, v_0 the velocity scale of yielding and x_0 the displacement scale of the pre-yield hysteresis. A
    large x_0 removes this hysteresis. The force is explicit: no equation must be solved. A cycle dissipates at least
    pi c omega X^2, and at most 4 f_0 X more.
    x (m), f (N). State: s[0] last displacement (m).
    Not valid where the force depends on the path and not only on x and v: stops, restarts, small cycles away from the centre.
    Source: after Kwok et al. (2006), "A novel hysteretic model for magnetorheological fluid dampers and parameter
    identification using particle swarm optimization", Sens. Actuators A 132, 441-451, with x / x_0 instead of
    delta sgn(x), whose force jumps at x = 0.
    """

    kind: Literal["hyperbolic_tangent"] = "hyperbolic_tangent"
    yield_force: float = quantity("Yield force f₀", "N", "kN", ge=0, le=1e9, default=1.5e5)
    velocity_scale: float = quantity("Velocity scale v₀", "m/s", "mm/s", gt=0, le=10, default=0.02)
    displacement_scale: float = quantity("Displacement scale x₀", "m", "mm", gt=0, le=1e6, default=0.05)
    stiffness: float = quantity("Stiffness k", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    damping: float = quantity("Damping coefficient c", "N*s/m", "kN*s/m", ge=0, le=1e12, default=1.0e5)
    title: ClassVar[str] = "Hyperbolic tangent damper"

    def build(self, dt: float) -> tuple[Array, Array]:
        scales = [self.yield_force, self.velocity_scale, self.displacement_scale]
        return np.array([*scales, self.stiffness, self.damping]), np.zeros(1)

    @staticmethod
    def step(p, s, x, dt):
        v = (x - s[0]) / dt
        s[0] = x
        return p[3] * x + p[4] * v + p[0] * math.tanh(v / p[1] + x / p[2])
