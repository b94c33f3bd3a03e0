"""Derivative feed-forward: adds the velocity and the acceleration of the command to the command."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem


class DerivativeFeedForward(Compensating):
    """Derivative feed-forward: adds the velocity and the acceleration of the command to the command.

    d_p[q] = d_c[q] + g_v (3 d_c[q] - 4 d_c[q-1] + d_c[q-2]) / (2 dt) + g_a (d_c[q] - 2 d_c[q-1] + d_c[q-2]) / dt^2

    It inverts a lag T with g_v = T, and a second-order actuator with g_v = 2 zeta / omega and g_a = 1 / omega^2. g_v is in s
    and g_a in s^2; the plan gives the root of g_a. State: s[0] unused, s[1] the command before the last command (m).
    Not valid at the kinks of a ramped command, where d_c'' is a spike: use g_a = 0 unless the command is smooth.
    Source: Jung and Shing (2006), "Performance evaluation of a real-time pseudodynamic test system", EESD 35, 789-810.
    """

    kind: Literal["derivative"] = "derivative"
    velocity_gain: float = quantity(
        "Velocity gain g_v", "s", "ms", ge=0, le=1, default=29 / 1024, help="the lag of the actuator"
    )
    acceleration_root: float = quantity(
        "Root of the acceleration gain √g_a", "s", "ms", ge=0, le=1, default=0.0, help="1/ω of a second-order actuator"
    )
    title: ClassVar[str] = "Derivative feed-forward"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """g_v and g_a of the inverse up to s^2, over its gain; g_a = 0 where the command has kinks."""
        gain, first, second = system.inverse(2)
        smooth = system.step <= system.dt
        return cls(velocity_gain=first / gain, acceleration_root=max(0.0, second / gain) ** 0.5 if smooth else 0.0)

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.velocity_gain / (2 * dt), (self.acceleration_root / dt) ** 2]), np.zeros(2)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        velocity = 3.0 * x_cmd - 4.0 * x_cmd_last + s[1]
        acceleration = x_cmd - 2.0 * x_cmd_last + s[1]
        s[1] = x_cmd_last
        return x_cmd + p[0] * velocity + p[1] * acceleration
