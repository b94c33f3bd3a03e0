"""Dual compensation: inverse compensation corrected by the tracking error."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
GAIN_MARGIN = 4.0  # of the feedback of the tracking error


class DualCompensation(Compensating):
    """Dual compensation: inverse compensation corrected by the tracking error.

    d_p[q] = alpha_es d_c[q] - (alpha_es - 1) d_c[q-1] + kp (d_c[q-1] - d_m[q-1])

    The tracking error of the last substep corrects the error of a wrong alpha_es: on a ramp, the lag of a first-order actuator
    falls from (alpha - alpha_es) controller steps to (alpha - alpha_es) / (1 + kp). kp = 0 is inverse compensation.
    State: none. Not stable at a high gain: with `FirstOrderDelay` the loop is stable while kp < 2 alpha - 1, and a dead time
    makes this limit much lower.
    Source: Chen and Ricles (2009), "Improving the inverse compensation method for real-time hybrid simulation through a dual
    compensation scheme", EESD 38, 1237-1255.
    """

    kind: Literal["dual"] = "dual"
    alpha_es: float = quantity(
        "Estimated delay constant α_es", ge=1, le=1000, default=30.0, help="compensates (α_es − 1) controller steps"
    )
    kp: float = quantity("Proportional gain on the tracking error", ge=0, le=100, default=1.0)
    title: ClassVar[str] = "Dual (inverse and proportional)"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """alpha_es of the delay; kp with a gain margin of 4 in the loop of the tracking error, at most the default."""
        kp = min(system.critical_gain / GAIN_MARGIN, cls().kp)
        return cls(alpha_es=1 + system.delay / system.dt, kp=kp)

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.alpha_es, self.kp]), np.zeros(1)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        return p[0] * x_cmd - (p[0] - 1.0) * x_cmd_last + p[1] * (x_cmd_last - x_meas)
