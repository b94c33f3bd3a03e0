"""Kalman predictor: the command through the inverse of the actuator's model, on a filtered model of the response."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, Self

import numpy as np
from scipy.linalg import expm, solve_discrete_are

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.actuator_model import ActuatorModel, fields_for
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem
from rths_engine.parts.compensators.synthesis import finite, synthesis

# chosen; see docs/decisions/0023
AHEAD = 10.0  # bandwidth w_c times the delay
WIDEST = 60.0  # Hz


class KalmanPredictor(Compensating):
    """Kalman predictor.

    d_p = e (I + 2 zeta F / omega + F^2 / omega^2) exp(F T) z / gain,  z' = F z + w,  z estimated from d_c,  e = (1, 0, 0)

    z = (d_c, d_c', d_c'') is a response of circular frequency w_r about a moving mean, d_c''' = -w_r^2 d_c', driven by white
    noise w; w_r = 0 is constant acceleration. `build` computes the gain of the stationary Kalman filter. Its bandwidth w_c is
    the root of the ratio of driving noise to noise of the command, (q / r)^(1/6); for w_r = 0 its poles are those of a
    Butterworth filter of third order. The row before z is the inverse of the actuator's model gain exp(-T s) /
    (1 + 2 zeta s / omega + s^2 / omega^2), T = delay - 2 zeta / omega, at s = F. It is exact for a constant velocity, for a
    sine of circular frequency w_r, and, where w_r = 0, for a parabola. The parameters hold z over powers of w_c.
    State: s[0] unused, s[1] to s[3] the estimate (m).
    Not valid for motion at frequencies near w_c and above: its prediction overshoots.
    Source: Kalman (1960), J. Basic Eng. 82, 35-45; white-noise jerk of Bar-Shalom, Li and Kirubarajan (2001), "Estimation with
    Applications to Tracking and Navigation", section 6.2.
    """

    kind: Literal["kalman"] = "kalman"
    gain: float = quantity("Static gain of the actuator's model", ge=0.2, le=5, default=1.0)
    delay: float = quantity("Delay τ", "s", "ms", ge=0, le=0.2, default=29 / 1024)
    frequency: float = quantity("Natural frequency of the actuator's model f", "Hz", ge=0.1, le=1000, default=15.0)
    damping_ratio: float = quantity("Damping ratio of the actuator's model ζ", "1", "%", ge=0.01, le=10, default=0.9)
    response_frequency: float = quantity(
        "Frequency of the response", "Hz", ge=0, le=100, default=1.0, help="0: constant acceleration"
    )
    bandwidth: float = quantity("Bandwidth of the filter", "Hz", ge=0.01, le=1000, default=20.0)
    title: ClassVar[str] = "Kalman predictor"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The model of the system, the mean frequency of the expected motion, and a bandwidth of 10 / delay, at most 60 Hz."""
        return cls(
            **fields_for(system),
            response_frequency=system.velocity / (2 * math.pi * system.displacement),
            bandwidth=min(WIDEST, AHEAD / (2 * math.pi * system.delay)) if system.delay > 0 else WIDEST,
        )

    def build(self, dt: float) -> tuple[Array, Array]:
        with synthesis(self, dt):
            return finite(self._gains(dt)), np.zeros(4)

    def _gains(self, dt: float) -> Array:
        model = ActuatorModel.of(self)
        pace = 2 * math.pi * self.bandwidth
        rates = pace * np.diag([1.0, 1.0], 1)  # F for z over powers of w_c
        rates[2, 1] = -pace * (self.response_frequency / self.bandwidth) ** 2
        driven = np.zeros((6, 6))  # Van Loan (1978): the covariance that white noise leaves after dt
        driven[:3, :3], driven[2, 5], driven[3:, 3:] = -rates, pace**2, rates.T
        grown = expm(driven * dt)
        move = grown[3:, 3:].T
        left = move @ grown[:3, 3:]
        spread = solve_discrete_are(move.T, np.eye(3)[:, :1], (left + left.T) / 2, [[1 / dt]])
        gain = spread[:, 0] / (spread[0, 0] + 1 / dt)
        inverse = np.eye(3) + 2 * model.damping_ratio / model.omega * rates + rates @ rates / model.omega**2
        row = (inverse @ expm(rates * model.dead_time))[0] / model.gain
        return np.array([*move.ravel(), *gain, *row])

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        z = p[0] * s[1] + p[1] * s[2] + p[2] * s[3]
        v = p[3] * s[1] + p[4] * s[2] + p[5] * s[3]
        a = p[6] * s[1] + p[7] * s[2] + p[8] * s[3]
        news = x_cmd - z
        s[1], s[2], s[3] = z + p[9] * news, v + p[10] * news, a + p[11] * news
        return p[12] * s[1] + p[13] * s[2] + p[14] * s[3]
