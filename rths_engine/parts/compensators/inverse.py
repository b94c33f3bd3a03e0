"""Inverse compensation: the inverse of the first-order delay, as an extrapolation of the command."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem


class InverseCompensation(Compensating):
    """Inverse compensation: the inverse of the first-order delay, as an extrapolation of the command.

    d_p[q] = alpha_es d_c[q] - (alpha_es - 1) d_c[q-1]   (7a with d_alpha = 0)

    Exact inverse of `FirstOrderDelay` (5a) when alpha_es equals the actuator's alpha. alpha_es = 1 means no compensation.
    State: none. Not valid when the estimated delay of the actuator is wrong or the delay changes during the test.
    Source: Chen and Ricles (2009), J. Eng. Mech. 135; equation numbers from Chen and Ricles (2012), EESD 41, 549-569.
    """

    kind: Literal["inverse"] = "inverse"
    alpha_es: float = quantity(
        "Estimated delay constant α_es", ge=1, le=1000, default=30.0, help="compensates (α_es − 1) controller steps"
    )
    title: ClassVar[str] = "Inverse"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """alpha_es of the delay at low frequency."""
        return cls(alpha_es=1 + system.delay / system.dt)

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.alpha_es]), np.zeros(1)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        return p[0] * x_cmd - (p[0] - 1.0) * x_cmd_last
