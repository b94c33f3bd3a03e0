"""Bouc-Wen hysteresis."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled
from rths_engine.foundation.part import Part, quantity

# chosen; see docs/decisions/0023
SATURATED = 20.0  # yield displacements: after a longer move zeta equals its asymptote within exp(-20 + 1)
SLIPPING = 1.0 - 1e-9  # share of the asymptote


@compiled
def _slope(zeta, way, n, eta):
    """x_y d zeta / dx while x moves in the direction `way`, 1 or -1."""
    turned = eta if zeta * way > 0.0 else -eta
    return 1.0 - abs(zeta) ** n * (turned + 1.0 - eta)


@compiled
def moved(zeta, ratio, n, eta):
    """Hysteretic variable zeta after a move of `ratio` yield displacements.

    Classical Runge-Kutta integration in parts shorter than 0.5 / n.
    """
    move = min(max(ratio, -SATURATED), SATURATED)
    way = 1.0 if move >= 0.0 else -1.0
    parts = math.ceil(2.0 * n * abs(move))
    for _ in range(parts):
        h = move / parts
        first = _slope(zeta, way, n, eta)
        second = _slope(zeta + 0.5 * h * first, way, n, eta)
        third = _slope(zeta + 0.5 * h * second, way, n, eta)
        fourth = _slope(zeta + h * third, way, n, eta)
        zeta += h * (first + 2.0 * second + 2.0 * third + fourth) / 6.0
        zeta = min(max(zeta, -1.0), 1.0)
        if zeta * way > SLIPPING:
            break
    return zeta


class BoucWen(Part):
    """Bouc-Wen hysteresis.

    f = r k x + (1 - r) f_y zeta,  x_y zeta' = v (1 - |zeta|^n (eta sgn(v zeta) + 1 - eta)),  x_y = f_y / k

    k is the initial stiffness, r the post-yield ratio, f_y the yield force, n the sharpness of yielding and
    eta = beta / (beta + gamma) the fullness of the unloading: eta = 0.5 unloads in a straight line with k, and from 0.5 to 1
    every cycle dissipates. The model is rate-independent. It is integrated over the displacement by classical Runge-Kutta in
    parts shorter than 0.5 x_y / n.
    x (m), f (N). State: s[0] last displacement (m), s[1] zeta. Monotonic from rest: zeta = 1 - exp(-x/x_y) for n = 1 and
    tanh(x/x_y) for n = 2.
    Not valid in small cycles after partial unloading, where the force drifts and the loop does not close (no Drucker
    stability), or where strength degrades.
    Source: Wen (1976), "Method for random vibration of hysteretic systems", J. Eng. Mech. Div. ASCE 102, 249-263.
    """

    kind: Literal["bouc_wen"] = "bouc_wen"
    stiffness: float = quantity("Initial stiffness k", "N/m", "kN/m", gt=0, le=1e12, default=5.0e7)
    yield_force: float = quantity("Yield force f_y", "N", "kN", gt=0, le=1e9, default=1.0e5)
    post_yield_ratio: float = quantity("Post-yield stiffness ratio r", ge=0, le=1, default=0.03)
    exponent: float = quantity("Exponent n", ge=1, le=20, default=2.0)
    fullness: float = quantity("Fullness η = β/(β + γ)", ge=0.5, le=1, default=0.5)
    title: ClassVar[str] = "Bouc-Wen hysteresis"

    def build(self, dt: float) -> tuple[Array, Array]:
        yield_displacement = self.yield_force / self.stiffness
        elastic = self.post_yield_ratio * self.stiffness
        plastic = (1 - self.post_yield_ratio) * self.yield_force
        return np.array([elastic, plastic, yield_displacement, self.exponent, self.fullness]), np.zeros(2)

    @staticmethod
    def step(p, s, x, dt):
        s[1] = moved(s[1], (x - s[0]) / p[2], p[3], p[4])
        s[0] = x
        return p[0] * x + p[1] * s[1]
