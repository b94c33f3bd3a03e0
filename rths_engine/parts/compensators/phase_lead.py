"""First-order phase-lead compensation."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem


class PhaseLead(Compensating):
    """First-order phase-lead compensation.

    r T d_p' + d_p = d_c + T d_c',  0 <= r < 1;  frequency response (1 + i omega T) / (1 + i omega r T)

    Discretised by the backward difference, like the actuator (5a), so that r = 0 with T = (alpha - 1) dt inverts it exactly.
    The compensator removes the delay (1 - r) T at low frequency and amplifies noise at most 1 / r times.
    State: s[0] unused, s[1] the last compensated command minus the last command (m), 0 at rest.
    Not valid above 1 / (2 pi T) Hz, where its amplitude grows faster than that of the actuator falls.
    Source: Zhao, French, Shield and Posbergh (2003), "Considerations for the development of real-time dynamic testing using
    servo-hydraulic actuation", EESD 32, 1773-1794.
    """

    kind: Literal["phase_lead"] = "phase_lead"
    lead_time: float = quantity("Lead time T", "s", "ms", ge=0, le=1, default=0.032)
    lag_ratio: float = quantity("Lag time over lead time r", ge=0, lt=1, default=0.1, help="amplifies noise by at most 1/r")
    title: ClassVar[str] = "Phase lead"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """T that removes the delay at the default lag ratio."""
        return cls(lead_time=system.delay / (1 - cls().lag_ratio))

    def build(self, dt: float) -> tuple[Array, Array]:
        lag = self.lag_ratio * self.lead_time
        return np.array([(self.lead_time - lag) / (dt + lag), lag / (dt + lag)]), np.zeros(2)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        s[1] = p[1] * s[1] + p[0] * (x_cmd - x_cmd_last)
        return x_cmd + s[1]
