"""Second-order dynamics that the actuator model lacks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np
from scipy.linalg import expm

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import COMMAND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said

# chosen; see docs/decisions/0023
SHORT = 0.01  # of a substep: a shorter T has no effect


class SecondOrderLag(Effect):
    """Second-order dynamics that the actuator model lacks.

    T^2 y'' + 2 zeta T y' + y = d,  T = 1 / (2 pi f)

    The command d passes an oil column or a valve of natural frequency f before it reaches the model's actuator. The step is
    exact for a command that is linear between substeps. y lags a ramp by 2 zeta T. Neutral: T = 0.
    State: s[0] y, s[1] T y' (m), s[2] last command, s[3] 1 after the first substep. It starts at rest.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley. Not valid where f falls with the amplitude.
    """

    kind: Literal["second_order_lag"] = "second_order_lag"
    time_constant: float = quantity("Time constant T", "s", "ms", ge=0, le=1, default=0.0)
    damping_ratio: float = quantity("Damping ratio ζ", "1", "%", gt=0, le=10, default=0.7)
    title: ClassVar[str] = "Second-order lag"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"time_constant": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        if self.time_constant < SHORT * dt:
            return np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]), np.zeros(4)
        angle = dt / self.time_constant
        rates = np.zeros((4, 4))  # of y, T y', the last command and its increment in a substep
        rates[0, 1], rates[1, :3] = angle, [-angle, -2 * self.damping_ratio * angle, angle]
        rates[2, 3] = 1.0
        return expm(rates)[:2].ravel(), np.zeros(4)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[3] == 0.0:
            s[0] = y
            s[2] = y
            s[3] = 1.0
        lagging, rate, last, increment = s[0], s[1], s[2], y - s[2]
        s[2] = y
        s[0] = p[0] * lagging + p[1] * rate + p[2] * last + p[3] * increment
        s[1] = p[4] * lagging + p[5] * rate + p[6] * last + p[7] * increment
        return s[0]


class SecondOrderLagSearch(Search[SecondOrderLag]):
    needs = ("x_comp", "x_meas")
    relatives = ("delay_error",)
    noun = "a second-order lag"

    def guesses(self, seen: Seen) -> Iterator[SecondOrderLag]:
        for frequency in (5.0, 15.0, 40.0):
            yield self.effect(time_constant=1 / (2 * math.pi * frequency))

    def says(self, effect: SecondOrderLag) -> str:
        frequency = said(1 / (2 * math.pi * max(effect.time_constant, 1e-9)), "Hz")
        return f"has a further lag of second order at {frequency} with {said(effect.damping_ratio, '%')} of critical damping"
