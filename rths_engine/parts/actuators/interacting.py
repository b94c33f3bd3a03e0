"""Transfer system with control-structure interaction: servo-valve, piston and attached load as one linear system."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from scipy.linalg import expm

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class InteractingActuator(Part):
    """Transfer system with control-structure interaction: servo-valve, piston and attached load as one linear system.

    q'' + beta_1 q' + beta_2 q = a_1 beta_0 (g d_p - y),  f' + a_3 f = q - a_2 y',  m y'' + c y' + k y = f - (F - F_0)

    q (N/s) is the rate of force that the valve drives, f (N) the piston force, y (m) the displacement. a_2 y' is the natural
    velocity feedback: the load changes the dynamics of the actuator. F is the specimen's force of the last controller step and
    F_0 the force that the load m, c and k had there by the differences of `LinearWithMass`: a specimen equal to the load adds
    nothing, another specimen acts one controller step late by the difference. The digital controller holds the command for one
    controller step and its converter is one step behind: the piston follows the command of the last step. Between the steps
    the solution is exact. `transfer_function` gives y / d_p. f stays within the force capacity, y' within its limit.
    State: s[0] q / a_1 beta_0 (m s^2), s[1] q' / a_1 beta_0 (m s), s[2] f (N), s[3] y (m), s[4] y' (m/s), s[5] the last command
    (m), s[6], s[7] the two y before the last (m).
    Not valid with a specimen much stiffer or heavier than the load: the part of its force that is late makes it unstable.
    Source: Silva, Gomez, Maghareh, Dyke and Spencer (2020), "Benchmark control problem for real-time hybrid simulation",
    Mech. Syst. Signal Process. 135, 106381; Dyke, Spencer, Quast and Sain (1995), J. Eng. Mech. 121, 322-338.
    """

    kind: Literal["interacting"] = "interacting"
    gain: float = quantity("Gain of the command g", ge=0.1, le=10, default=1.0261)
    valve_gain: float = quantity("Gain of valve and piston a₁β₀", "N/(m*s^3)", gt=0, le=1e20, default=2.1283e13)
    valve_damping: float = quantity("Servo-valve β₁", "1/s", gt=0, le=1e6, default=425.0)
    valve_stiffness: float = quantity("Servo-valve β₂", "1/s^2", gt=0, le=1e10, default=9.9976e4)
    velocity_feedback: float = quantity("Natural velocity feedback a₂", "N/m", "kN/m", ge=0, le=1e12, default=4.2297e6)
    leakage: float = quantity("Leakage of the piston a₃", "1/s", ge=0, le=1e4, default=3.3)
    load_mass: float = quantity("Mass of the attached load m", "kg", gt=0, le=1e6, default=29.13)
    load_damping: float = quantity("Damping of the attached load c", "N*s/m", ge=0, le=1e9, default=114.22)
    load_stiffness: float = quantity("Stiffness of the attached load k", "N/m", "kN/m", ge=0, le=1e12, default=1.19e6)
    velocity_limit: float = quantity("Velocity limit", "m/s", "mm/s", gt=0, le=10, default=1.0)
    force_limit: float = quantity("Force capacity", "N", "kN", gt=0, le=1e8, default=8900.0)
    title: ClassVar[str] = "Servo-valve and piston with control-structure interaction"

    def transfer_function(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Numerator and denominator of y / d_p with the attached load, highest power of s first."""
        load = np.array([self.load_mass, self.load_damping, self.load_stiffness])
        piston = np.polyadd(np.polymul([1.0, self.leakage], load), [self.velocity_feedback, 0.0])
        denominator = np.polyadd(np.polymul([1.0, self.valve_damping, self.valve_stiffness], piston), [self.valve_gain])
        return (self.gain * self.valve_gain,), tuple(float(one) for one in denominator)

    def build(self, dt: float) -> tuple[Array, Array]:
        m, c, k = self.load_mass, self.load_damping, self.load_stiffness
        rates = np.zeros((7, 7))  # for q, q', f, y, y', the command and the further force on the load
        rates[0, 1] = 1.0
        rates[1, [0, 1, 3, 5]] = -self.valve_stiffness, -self.valve_damping, -1.0, self.gain
        rates[2, [0, 2, 4]] = self.valve_gain, -self.leakage, -self.velocity_feedback
        rates[3, 4] = 1.0
        rates[4, [2, 3, 4, 6]] = 1 / m, -k / m, -c / m, -1 / m
        rows = expm(rates * dt)[:5].ravel()
        held = expm(np.array([[0.0, 1.0, 0.0], [-k / m, -c / m, 1 / m], [0.0, 0.0, 0.0]]) * dt)[:2].ravel()
        limits = [self.velocity_limit * dt, dt, self.force_limit]
        return np.array([*rows, k, c / dt, m / dt**2, *limits, *held]), np.zeros(8)

    @staticmethod
    def step(p, s, x_comp, force):
        last, before, earlier = s[3], s[6], s[7]
        own = p[35] * last + p[36] * (last - before) + p[37] * (last - 2.0 * before + earlier)
        further, sent = force - own, s[5]
        valve, valve_rate, piston, y, v = s[0], s[1], s[2], last, s[4]
        for i in range(5):
            r = 7 * i
            s[i] = p[r] * valve + p[r + 1] * valve_rate + p[r + 2] * piston + p[r + 3] * y + p[r + 4] * v
            s[i] += p[r + 5] * sent + p[r + 6] * further
        if abs(s[2]) > p[40]:  # the load moves under the capacity instead
            s[2] = min(max(s[2], -p[40]), p[40])
            s[3] = p[41] * y + p[42] * v + p[43] * (s[2] - further)
            s[4] = p[44] * y + p[45] * v + p[46] * (s[2] - further)
        move = s[3] - y
        held = min(max(move, -p[38]), p[38])
        if held != move:
            s[3] = y + held
            s[4] = held / p[39]
        s[5], s[6], s[7] = x_comp, last, before
        return s[3]
