"""Polynomial extrapolation of the command over the actuator's delay."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem


class PolynomialExtrapolation(Compensating):
    """Polynomial extrapolation of the command over the actuator's delay.

    d_p(t) = sum over i = 0 ... n of w_i d_c(t - i h) = P(t + tau),  P the polynomial of order n through these samples

    tau (s) is the delay and h the whole number of controller steps nearest to tau, at least one step. For h = tau the weights
    are the published 2, -1 (n = 1), 3, -3, 1 (n = 2) and 4, -6, 4, -1 (n = 3). Exact for polynomials of order n.
    State: s[0] unused, s[1] position in the ring, then the ring of the last n h / dt + 1 commands (m).
    Not valid at higher frequencies, where order n amplifies up to 2^(n+1) - 1 times: a higher mode with little damping becomes
    unstable.
    Source: Horiuchi, Inoue, Konno and Namita (1999), EESD 28, 1121-1141.
    """

    kind: Literal["polynomial"] = "polynomial"
    delay: float = quantity("Delay τ", "s", "ms", ge=0, le=0.1, default=29 / 1024)
    order: int = quantity("Order of the polynomial n", ge=1, le=3, default=3)
    title: ClassVar[str] = "Polynomial extrapolation"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The delay at low frequency and the published order 3."""
        return cls(delay=system.delay)

    def build(self, dt: float) -> tuple[Array, Array]:
        spacing = max(1, round(self.delay / dt))
        ahead = self.delay / (spacing * dt)
        weights = np.zeros(4)
        for i in range(self.order + 1):
            others = [j for j in range(self.order + 1) if j != i]
            weights[i] = np.prod([(ahead + j) / (j - i) for j in others])
        length = self.order * spacing + 1
        return np.array([spacing, self.order, length, *weights]), np.zeros(2 + length)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        spacing, order, length = int(p[0]), int(p[1]), int(p[2])
        newest = int(s[1])
        s[2 + newest] = x_cmd
        x_comp = 0.0
        for i in range(order + 1):
            x_comp += p[3 + i] * s[2 + (newest - i * spacing) % length]
        s[1] = (newest + 1) % length
        return x_comp
