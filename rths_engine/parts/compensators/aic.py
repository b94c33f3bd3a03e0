"""Adaptive inverse compensation (AIC)."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
ADAPTATION_TIME = 1.0  # s, in which the delay error falls to 1/e under the expected motion


class AdaptiveInverseCompensation(Compensating):
    """Adaptive inverse compensation (AIC).

    d_p[q] = alpha d_c[q] - (alpha - 1) d_c[q-1],  alpha = alpha_es + d_alpha   (7a)
    d_alpha = kp TI + ki integral of TI dt   (7b)

    TI is the tracking indicator (m^2) up to the last substep; the integral is trapezoidal. The published gains are
    kp = 0.4 1/mm^2 and ki = kp/10 per second, for TI in mm^2.
    State: s[0] d_alpha (recorded), s[1] integral of TI (m^2 s), s[2] last TI (m^2).
    Not valid when the command hardly moves: TI then contains no information about the delay.
    Source: Chen and Ricles (2012), EESD 41, 549-569, equations (7a) and (7b).
    """

    kind: Literal["aic"] = "aic"
    alpha_es: float = quantity("Estimated delay constant α_es", ge=1, le=1000, default=30.0, help="start value of α")
    kp: float = quantity("Proportional gain kp", "1/(m^2)", "1/(mm^2)", ge=0, le=1e8, default=0.4e6)
    ki: float = quantity("Integral gain ki", "1/(m^2*s)", "1/(mm^2*s)", ge=0, le=1e8, default=0.04e6, help="published as kp/10")
    title: ClassVar[str] = "Adaptive inverse (AIC)"
    adaptive: ClassVar[bool] = True

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """alpha_es of the delay; kp from TI' = d v^2 with delay error d and RMS velocity v, to adapt within a second."""
        kp = system.rate / (ADAPTATION_TIME * system.velocity**2)
        return cls(alpha_es=1 + system.delay / system.dt, kp=kp, ki=kp / 10)

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.alpha_es, self.kp, self.ki]), np.zeros(3)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        s[1] += 0.5 * (ti + s[2]) * dt
        s[2] = ti
        s[0] = p[1] * ti + p[2] * s[1]
        alpha = p[0] + s[0]
        return alpha * x_cmd - (alpha - 1.0) * x_cmd_last
