"""No compensation: d_p[q] = d_c[q]."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.compensators.compensator import Compensating


class NoCompensation(Compensating):
    """No compensation, d_p[q] = d_c[q]: the delay of the actuator is not corrected and adds energy to the structure."""

    kind: Literal["none"] = "none"
    title: ClassVar[str] = "None"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        return x_cmd
