"""Constant current, the passive mode of a controllable damper."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.controllers.controller import Commanding


class ConstantCurrent(Commanding):
    """Constant current, the passive mode of a controllable damper: i = i_0.

    i_0 = 0 is called passive-off, and the largest current of the supply passive-on.
    """

    kind: Literal["constant"] = "constant"
    current: float = quantity("Current i₀", "A", ge=0, le=1000, default=2.5)
    title: ClassVar[str] = "Constant current"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.current]), np.zeros(1)

    @property
    def range(self) -> tuple[float, float]:
        return self.current, self.current

    @staticmethod
    def step(p, s, d, v, f, dt):
        return p[0]
