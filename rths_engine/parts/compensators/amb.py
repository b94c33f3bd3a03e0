"""Adaptive model-based compensation (AMB)."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.actuator_model import ActuatorModel, fields_for
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
FINEST = 1e-3  # s, step of the derivatives of a smooth command
FILTERS, COEFFICIENTS, RINGS = 3, 7, 11  # places in the state


class AdaptiveModelBased(Compensating):
    """Adaptive model-based compensation (AMB).

    d_p = a0 d_c + a1 d_c' + a2 d_c'' + a3 d_c''',  b_k = a_k w_r^k,
    b_k' = g (d_p - b . Phi) Phi_k S / ((e^2 + S) (e^2 + Phi . Phi)),  S = Phi_0^2 + Phi_1^2

    The coefficients a are those of the inverse of a third-order model of the actuator. Phi_k is the derivative of order k of
    the measured displacement over w_r^k. With w_r, the dominant circular frequency of the response, the Phi_k are equally
    large, so that the gradient finds all coefficients at about the rate g. d_p and d_m pass two equal first-order low-pass
    filters before. Derivatives are backward differences over h. With h = one integration step, the kinks of the ramped command
    do not enter them. The adaptation fades where the displacement falls below e. Start: the series of the inverse of
    gain exp(-T s) / (1 + 2 zeta s / omega + s^2 / omega^2), T = delay - 2 zeta / omega. Bounds: |a0 - 1 / gain| <= gain_range,
    0 <= a_k <= tau_max^k / k!.
    State: s[0] (a1 - delay) / dt (recorded as d_alpha), s[1] index in the rings, s[2] last d_p (m), then filters (4), b (4),
    and the rings of d_c and of filtered d_m.
    Not valid where sensor noise exceeds e: it lowers all coefficients, the higher ones first.
    Source: Chen, Chang, Spencer and Tsai (2015), Bull. Earthquake Eng. 13, 1627-1651; Fermandois (2019), Mech. Syst. Signal
    Process. 131, 394-416; normalised gradient after Galmez and Fermandois (2022), Struct. Control Health Monit. 29, e2962.
    """

    kind: Literal["amb"] = "amb"
    gain: float = quantity("Static gain of the actuator's model", ge=0.2, le=5, default=1.0)
    delay: float = quantity("Estimated delay τ", "s", "ms", ge=0, le=0.2, default=29 / 1024, help="start value of a1")
    frequency: float = quantity("Natural frequency of the actuator's model f", "Hz", ge=0.1, le=1000, default=15.0)
    damping_ratio: float = quantity("Damping ratio of the actuator's model ζ", "1", "%", ge=0.01, le=10, default=0.9)
    largest_delay: float = quantity("Largest delay a1, τ_max", "s", "ms", gt=0, le=0.2, default=0.06)
    gain_range: float = quantity("Range of the amplitude coefficient a0", ge=0, le=0.9, default=0.3)
    response_frequency: float = quantity("Dominant frequency of the response", "Hz", gt=0, le=100, default=1.0)
    rate: float = quantity("Adaptation rate g", "1/s", ge=0, le=1000, default=100.0)
    derivative_step: float = quantity("Step of the derivatives h", "s", "ms", gt=0, le=0.05, default=10 / 1024)
    cutoff: float = quantity("Low-pass filter before the adaptation", "Hz", gt=0, le=1000, default=20.0)
    threshold: float = quantity("Displacement below which the adaptation fades", "m", "mm", gt=0, le=1, default=0.25e-3)
    title: ClassVar[str] = "Adaptive model-based (AMB)"
    adaptive: ClassVar[bool] = True

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The model of the system, the mean frequency of the expected motion, and derivatives over one integration step."""
        return cls(
            **fields_for(system),
            largest_delay=2 * system.delay,
            response_frequency=system.velocity / (2 * math.pi * system.displacement),
            derivative_step=max(system.step, system.dt, FINEST),
            threshold=system.displacement / 10,
        )

    def build(self, dt: float) -> tuple[Array, Array]:
        spacing = max(1, round(self.derivative_step / dt))
        length = 3 * spacing + 1
        pace = 2 * math.pi * self.response_frequency
        smoothing = 1 - math.exp(-2 * math.pi * self.cutoff * dt)
        powers = pace ** np.arange(4.0)
        largest = self.largest_delay ** np.arange(4.0) / np.array([1.0, 1.0, 2.0, 6.0]) * powers
        low, high = np.array([1 / self.gain - self.gain_range, 0.0, 0.0, 0.0]), largest
        high[0] = 1 / self.gain + self.gain_range
        start = np.clip(ActuatorModel.of(self).inverse() * powers, low, high)
        gain = min(self.rate * dt, 1.0)
        head = [spacing, length, 1 / (pace * spacing * dt), smoothing, gain, self.threshold**2, start[1] / pace, 1 / pace]
        state = np.zeros(RINGS + 2 * length)
        state[COEFFICIENTS:RINGS] = start
        return np.array([*head, *low, *high]), state

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        spacing, length, newest, c = int(p[0]), int(p[1]), int(s[1]), COEFFICIENTS
        one, two, three = (newest - spacing) % length, (newest - 2 * spacing) % length, (newest + 1) % length
        s[1] = three
        s[FILTERS] += p[3] * (x_meas - s[FILTERS])
        s[FILTERS + 1] += p[3] * (s[FILTERS] - s[FILTERS + 1])
        s[FILTERS + 2] += p[3] * (s[2] - s[FILTERS + 2])
        s[FILTERS + 3] += p[3] * (s[FILTERS + 2] - s[FILTERS + 3])
        commands, measured = RINGS, RINGS + length
        s[commands + newest] = x_cmd
        s[measured + newest] = s[FILTERS + 1]

        x, x1, x2, x3 = s[measured + newest], s[measured + one], s[measured + two], s[measured + three]
        v, a, j = (x - x1) * p[2], (x - 2.0 * x1 + x2) * p[2] ** 2, (x - 3.0 * x1 + 3.0 * x2 - x3) * p[2] ** 3
        error = s[FILTERS + 3] - (s[c] * x + s[c + 1] * v + s[c + 2] * a + s[c + 3] * j)
        size = x * x + v * v
        move = p[4] * error * size / ((p[5] + size) * (p[5] + size + a * a + j * j))
        s[c] = min(max(s[c] + move * x, p[8]), p[12])
        s[c + 1] = min(max(s[c + 1] + move * v, p[9]), p[13])
        s[c + 2] = min(max(s[c + 2] + move * a, p[10]), p[14])
        s[c + 3] = min(max(s[c + 3] + move * j, p[11]), p[15])
        s[0] = (s[c + 1] * p[7] - p[6]) / dt

        x1, x2, x3 = s[commands + one], s[commands + two], s[commands + three]
        v, a, j = (x_cmd - x1) * p[2], (x_cmd - 2.0 * x1 + x2) * p[2] ** 2, (x_cmd - 3.0 * x1 + 3.0 * x2 - x3) * p[2] ** 3
        s[2] = s[c] * x_cmd + s[c + 1] * v + s[c + 2] * a + s[c + 3] * j
        return s[2]
