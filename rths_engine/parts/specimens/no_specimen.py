"""No specimen: the actuator moves freely, or against a specimen that several stations share."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part


class NoSpecimen(Part):
    """No specimen of the station's own: f = 0.

    The actuator moves freely, or against the specimen of a coupling that several stations share (`planning.coupling`).
    """

    kind: Literal["none"] = "none"
    title: ClassVar[str] = "None"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    @staticmethod
    def step(p, s, x, dt):
        return 0.0
