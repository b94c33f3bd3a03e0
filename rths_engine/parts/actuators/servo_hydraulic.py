"""Servo-hydraulic actuator: valve flow, oil column and supply pressure."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np
from scipy.linalg import expm

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class ServoHydraulicActuator(Part):
    """Servo-hydraulic actuator: valve flow, oil column and supply pressure.

    T_v o' = clip((d_p - y) / (T v_0), -1, 1) - o,  g = v_0 o sqrt(1 - sgn(o) p_L / p_s),  A p_L' = k_h (g - y'),
    m y'' = A p_L + 2 zeta sqrt(k_h m) (g - y') - F

    o is the valve opening, g the valve flow over the piston area A (m/s), p_L the load pressure and p_s the supply pressure.
    A p_s is the force capacity and v_0 the velocity without load at full opening. F is the specimen's force of the last
    substep. Beyond p_L = p_s the flow reverses. On a ramp against a constant force the lag is T / sqrt(1 - F / (A p_s)) - dt.
    The delay therefore grows with the force and, beyond a tracking error of T v_0, with the commanded velocity. With F = 0 and
    unlimited bandwidths the model equals `FirstOrderDelay` with alpha = T / dt. The oil column and the mass are integrated
    exactly for constant g and F; g is implicit in p_L and is the root of a quadratic equation.
    State: s[0] y (m), s[1] y' / omega_h (m), s[2] oil compression A p_L / k_h (m), s[3] o; omega_h = sqrt(k_h / m).
    Not valid with a specimen that is stiff or viscous relative to the mass (c dt > 2 m): its force, one substep late, then
    makes the oil column unstable. Not valid where T < 1 / (2 zeta omega_h): the position loop then makes it unstable.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley; Zhao, French, Shield and Posbergh (2003), EESD 32, 1773-1794.
    """

    kind: Literal["servo_hydraulic"] = "servo_hydraulic"
    time_constant: float = quantity("Time constant of the position loop T", "s", "ms", gt=0, le=10, default=30 / 1024)
    valve_time: float = quantity("Time constant of the servo-valve T_v", "s", "ms", ge=0, le=1, default=0.004)
    velocity_limit: float = quantity("Velocity without load v₀", "m/s", "mm/s", gt=0, le=10, default=0.56)
    force_limit: float = quantity("Force capacity A p_s", "N", "kN", gt=0, le=1e8, default=2.3e6)
    oil_stiffness: float = quantity("Oil column stiffness k_h", "N/m", "kN/m", gt=0, le=1e12, default=5.0e8)
    oil_damping: float = quantity("Damping ratio of the oil column ζ", "1", "%", gt=0, le=10, default=0.2)
    mass: float = quantity("Moving mass m", "kg", "t", gt=0, le=1e6, default=2000.0)
    title: ClassVar[str] = "Servo-hydraulic"

    def build(self, dt: float) -> tuple[Array, Array]:
        omega = math.sqrt(self.oil_stiffness / self.mass)
        rates = np.zeros((5, 5))  # over omega, for y, y' / omega, oil compression, g / omega, F / k_h
        rates[0, 1] = 1.0
        rates[1, 1:] = -2 * self.oil_damping, 1.0, 2 * self.oil_damping, -1.0
        rates[2, 1], rates[2, 3] = -1.0, 1.0
        rows = expm(rates * omega * dt)[:3]
        opening = 1 / (self.time_constant * self.velocity_limit)
        decay = math.exp(-dt / self.valve_time) if self.valve_time > 0 else 0.0
        pressure = self.oil_stiffness / self.force_limit
        hydraulics = [opening, decay, self.velocity_limit / omega, pressure, 1 / self.oil_stiffness]
        return np.array([*hydraulics, *rows[:, 1:].ravel()]), np.zeros(4)

    @staticmethod
    def step(p, s, x_comp, force):
        asked = min(max(p[0] * (x_comp - s[0]), -1.0), 1.0)
        s[3] = asked + p[1] * (s[3] - asked)
        speed, sense = abs(s[3]) * p[2], 1.0 if s[3] >= 0.0 else -1.0
        rate, oil, resisted = s[1], s[2], force * p[4]
        still = p[13] * rate + p[14] * oil + p[16] * resisted  # oil compression at the end of the substep without flow
        drop = 1.0 - sense * p[3] * still
        relief = p[3] * max(p[15], 0.0) * speed
        root = relief + math.sqrt(relief * relief + 4.0 * abs(drop))
        flow = sense * speed * 2.0 * drop / root if root > 0.0 else 0.0
        s[0] += p[5] * rate + p[6] * oil + p[7] * flow + p[8] * resisted
        s[1] = p[9] * rate + p[10] * oil + p[11] * flow + p[12] * resisted
        s[2] = still + p[15] * flow
        return s[0]
