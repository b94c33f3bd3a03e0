"""Proportional-integral control of the tracking error, with phase lead of the command."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
GAIN_MARGIN = 2.0  # of the loop of feedback


class PiPhaseLead(Compensating):
    """Proportional-integral control of the tracking error, with phase lead of the command.

    d_p = kp e + ki integral of e dt,  e = r - d_m,  T_2 r' + r = d_c + T_1 d_c'

    A loop of feedback around the actuator. At low frequency it delays by 1 / (ki G_0), with the actuator's amplitude at rest
    G_0; the phase lead removes T_1 - T_2 of this delay. Both are discretised by the trapezoidal rule. d_m is that of the last
    controller step. The defaults are the published sample controller of the virtual RTHS benchmark: kp = 2, ki = 95 1/s and
    the lead (50.83 s + 8570) / (s + 8570).
    State: s[0] unused, s[1] r (m), s[2] last command (m), s[3] integral of e (m s), s[4] last e (m).
    Not stable where kp exceeds the critical gain of the actuator: sensor noise passes kp times to the command below it.
    Source: Silva, Gomez, Maghareh, Dyke and Spencer (2020), Mech. Syst. Signal Process. 135, 106381, section 5.
    """

    kind: Literal["pi_phase_lead"] = "pi_phase_lead"
    kp: float = quantity("Proportional gain kp", ge=0, le=1000, default=2.0)
    ki: float = quantity("Integral gain ki", "1/s", ge=0, le=1e6, default=95.0)
    lead_time: float = quantity("Lead time T₁", "s", "ms", ge=0, le=1, default=50.8316336 / 8570.39733944)
    lag_time: float = quantity("Lag time T₂", "s", "ms", ge=0, le=1, default=1 / 8570.39733944)
    title: ClassVar[str] = "PI with phase lead"

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """Kp with a gain margin of 2, an integral time of the delay, and the lead that removes the delay of the loop."""
        kp = min(system.critical_gain / GAIN_MARGIN, cls().kp)
        ki = kp / system.delay if system.delay > 0 else 0.0
        lag = min(cls().lag_time, 1 / ki / system.gain) if ki > 0 else 0.0
        return cls(kp=kp, ki=ki, lead_time=lag + 1 / (ki * system.gain) if ki > 0 else 0.0, lag_time=lag)

    def build(self, dt: float) -> tuple[Array, Array]:
        lead, lag = 2 * self.lead_time / dt, 2 * self.lag_time / dt
        return np.array([(1 + lead) / (1 + lag), (1 - lead) / (1 + lag), (lag - 1) / (1 + lag), self.kp, self.ki]), np.zeros(5)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        s[1] = p[0] * x_cmd + p[1] * s[2] + p[2] * s[1]
        s[2] = x_cmd
        error = s[1] - x_meas
        s[3] += 0.5 * (error + s[4]) * dt
        s[4] = error
        return p[3] * error + p[4] * s[3]
