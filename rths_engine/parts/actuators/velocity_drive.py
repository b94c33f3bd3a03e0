"""Electric drive in open loop: a voltage commands a velocity."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class VelocityDrive(Part):
    """Electric drive in open loop: a voltage commands a velocity.

    T y'' + y' = clip(k (u - u_0), -v_max, v_max)

    The command is the voltage u (V) at the amplifier, not a displacement. k is the gain, u_0 the voltage at which the drive
    rests, T the time constant of motor and carriage. The amplifier saturates at v_max, that is at v_max / k in volts. The step
    is exact for a voltage that is constant over a substep. While the specimen resists with force_limit or more, the drive
    stalls against the force, one substep behind it. State: s[0] y (m), s[1] y' (m/s).
    Not valid at low voltage, where the friction of the guides absorbs a share of it.
    Source: Franklin, Powell and Emami-Naeini (2010), "Feedback Control of Dynamic Systems", section 2.3: the DC motor whose
    inductance is neglected.
    """

    kind: Literal["velocity_drive"] = "velocity_drive"
    gain: float = quantity("Gain k", "m/(s*V)", "mm/(s*V)", gt=0, le=100, default=5.0)
    time_constant: float = quantity("Time constant T", "s", "ms", gt=0, le=10, default=0.01)
    rest_voltage: float = quantity("Voltage at rest u₀", "V", "mV", ge=-100, le=100, default=0.0)
    velocity_limit: float = quantity("Velocity limit", "m/s", "mm/s", gt=0, le=10, default=0.56)
    force_limit: float = quantity("Force capacity", "N", "kN", gt=0, le=1e8, default=2.3e6)
    title: ClassVar[str] = "Velocity drive"

    def build(self, dt: float) -> tuple[Array, Array]:
        decay = math.exp(-dt / self.time_constant)
        travel = self.time_constant * (1 - decay)
        return np.array([self.gain, self.rest_voltage, self.velocity_limit, decay, travel, dt, self.force_limit]), np.zeros(2)

    @staticmethod
    def step(p, s, x_comp, force):
        asked = min(max(p[0] * (x_comp - p[1]), -p[2]), p[2])
        rest = s[1] - asked
        move = asked * p[5] + rest * p[4]
        s[1] = asked + rest * p[3]
        if (force >= p[6] and move > 0.0) or (force <= -p[6] and move < 0.0):
            move = 0.0
            s[1] = 0.0
        s[0] += move
        return s[0]
