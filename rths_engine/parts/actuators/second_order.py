"""Second-order actuator with dead time."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np
from scipy.linalg import expm

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class SecondOrderActuator(Part):
    """Second-order actuator with dead time.

    y'' + 2 zeta omega y' + omega^2 y = omega^2 d_p(t - T),  omega = 2 pi f

    The step is exact for a command that is linear between substeps; a dead time that is not a whole number of substeps is
    interpolated. y lags a ramp by 2 zeta / omega + T. The increment is limited to velocity_limit * dt. While the specimen
    resists with force_limit or more, the piston stalls against the force, one substep behind it. After a limit or a stall the
    motion continues from the actual velocity.
    State: s[0] y (m), s[1] y' / omega (m), s[2] last delayed command (m), s[3] index in the ring, then the ring of commands.
    Not valid where the servo-valve saturates: f and zeta then decrease with the amplitude.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley; dead time after Horiuchi et al. (1999), EESD 28, 1121-1141.
    """

    kind: Literal["second_order"] = "second_order"
    frequency: float = quantity("Natural frequency f", "Hz", gt=0, le=1000, default=15.0)
    damping_ratio: float = quantity("Damping ratio ζ", "1", "%", gt=0, le=10, default=0.9)
    dead_time: float = quantity("Dead time T", "s", "ms", ge=0, le=0.1, default=0.005)
    velocity_limit: float = quantity("Velocity limit", "m/s", "mm/s", gt=0, le=10, default=0.56)
    force_limit: float = quantity("Force capacity", "N", "kN", gt=0, le=1e8, default=2.3e6)
    title: ClassVar[str] = "Second order with dead time"

    def build(self, dt: float) -> tuple[Array, Array]:
        angle = 2 * math.pi * self.frequency * dt
        rates = np.zeros((4, 4))  # for y, y' / omega, the delayed command and its increment in a substep
        rates[0, 1], rates[1, :3] = angle, [-angle, -2 * self.damping_ratio * angle, angle]
        rates[2, 3] = 1.0
        rows = expm(rates)[:2].ravel()
        whole = math.floor(self.dead_time / dt + 1e-9)
        rest = max(0.0, self.dead_time / dt - whole)
        length = whole + 2
        return np.array([*rows, length, rest, self.velocity_limit * dt, self.force_limit, angle]), np.zeros(4 + length)

    @staticmethod
    def step(p, s, x_comp, force):
        length = int(p[8])
        newest = int(s[3])
        s[4 + newest] = x_comp
        oldest = (newest + 1) % length
        s[3] = oldest
        delayed = s[4 + (newest + 2) % length] + p[9] * (s[4 + oldest] - s[4 + (newest + 2) % length])
        y, rate, last, increment = s[0], s[1], s[2], delayed - s[2]
        s[2] = delayed
        move = p[0] * y + p[1] * rate + p[2] * last + p[3] * increment - y
        s[1] = p[4] * y + p[5] * rate + p[6] * last + p[7] * increment
        held = min(max(move, -p[10]), p[10])
        if (force >= p[11] and held > 0.0) or (force <= -p[11] and held < 0.0):
            held = 0.0
        if held != move:
            s[1] = held / p[12]
        s[0] = y + held
        return s[0]
