"""No controller: the specimen has no current of its own."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.controllers.controller import Commanding


class NoControl(Commanding):
    """No controller: the specimen has no current of its own, and i = 1 A stands for it in the laws of left-out effects."""

    kind: Literal["none"] = "none"
    title: ClassVar[str] = "None"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    @property
    def range(self) -> tuple[float, float]:
        return 1.0, 1.0

    @staticmethod
    def step(p, s, d, v, f, dt):
        return 1.0
