"""On-off control by displacement and velocity of the damper."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import ValidationInfo, field_validator

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.controllers.controller import Commanding


class OnOff(Commanding):
    """On-off control by displacement and velocity of the damper.

    i = i_on while d v < 0, else i_off

    d (m) and v (m/s) are the command displacement of the damper and its velocity. While the structure returns to rest, its
    spring force and the damper force oppose each other, so the damper force does not add to the acceleration.
    Not valid under long one-sided motion: around a residual displacement the sign of d does not change.
    Source: Rakheja and Sankar (1985), "Vibration and shock isolation performance of a semi-active on-off damper", J. Vib.
    Acoust. Stress Reliab. Des. 107, 398-403.
    """

    kind: Literal["on_off"] = "on_off"
    off_current: float = quantity("Current when off", "A", ge=0, le=1000, default=0.0)
    on_current: float = quantity("Current when on", "A", ge=0, le=1000, default=2.5)
    title: ClassVar[str] = "On-off"

    @field_validator("on_current")
    @classmethod
    def _above(cls, value: float, info: ValidationInfo) -> float:
        if value < (least := info.data.get("off_current", 0.0)):
            raise ValueError(f"needs a value >= {least:g} A, the current when off")
        return value

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.off_current, self.on_current]), np.zeros(1)

    @property
    def range(self) -> tuple[float, float]:
        return self.off_current, self.on_current

    @staticmethod
    def step(p, s, d, v, f, dt):
        return p[1] if d * v < 0.0 else p[0]
