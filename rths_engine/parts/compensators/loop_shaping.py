"""H-infinity loop shaping: the controller that tolerates the largest uncertainty of a shaped plant, and its estimator."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import solve_continuous_are

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
SUBOPTIMAL = 1.1  # of the least gamma


class Linear(NamedTuple):
    """A linear system x' = a x + b u, y = c x + d u: a (n, n), b (n, 1), c (1, n), d a number."""

    a: Array
    b: Array
    c: Array
    d: float = 0.0

    def at(self, s: complex) -> complex:
        """The transfer function."""
        return complex((self.c @ np.linalg.solve(s * np.eye(len(self.a)) - self.a, self.b))[0, 0]) + self.d

    def behind(self, first: Linear) -> Linear:
        """This system with the output of `first` as its input."""
        n, m = len(self.a), len(first.a)
        a = np.block([[self.a, self.b @ first.c], [np.zeros((m, n)), first.a]])
        b = np.vstack([self.b * first.d, first.b])
        return Linear(a, b, np.hstack([self.c, self.d * first.c]), self.d * first.d)

    def sampled(self, dt: float) -> Linear:
        """The discrete system by the bilinear (Tustin) transformation."""
        half = np.linalg.inv(np.eye(len(self.a)) - self.a * dt / 2)
        a = half @ (np.eye(len(self.a)) + self.a * dt / 2)
        b = half @ self.b * dt
        return Linear(a, b, self.c @ half, self.d + float((self.c @ b)[0, 0]) / 2)


def robust_controller(plant: Linear) -> tuple[Linear, float]:
    """The controller u = K e for a shaped plant without direct feedthrough, e = r - y, and its gamma.

    gamma_min = sqrt(1 + rho(X Z)) with the solutions of A' X + X A - X B B' X + C' C = 0 and A Z + Z A' - Z C' C Z + B B' = 0.
    The closed loop is stable for every plant whose normalised coprime factors are off by less than 1 / gamma.
    Source: McFarlane and Glover (1992), "A loop-shaping design procedure using H-infinity synthesis", IEEE Trans. Autom.
    Control 37, 759-769; formulas of Skogestad and Postlethwaite (2005), "Multivariable Feedback Control",
    equations (9.68) to (9.72).
    """
    a, b, c = plant.a, plant.b, plant.c
    one = np.eye(1)
    x = solve_continuous_are(a, b, c.T @ c, one)
    z = solve_continuous_are(a.T, c.T, b @ b.T, one)
    gamma = SUBOPTIMAL * float(np.sqrt(1 + np.max(np.abs(np.linalg.eigvals(x @ z)))))
    weight = (1 - gamma**2) * np.eye(len(a)) + x @ z
    feed = gamma**2 * np.linalg.solve(weight.T, z @ c.T)
    return Linear(a - b @ b.T @ x + feed @ c, feed, -b.T @ x), gamma
