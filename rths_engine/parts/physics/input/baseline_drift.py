"""A ground motion whose zero line moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect, Seen
from rths_engine.parts.physics.wording import said


class BaselineDrift(Effect):
    """a = a_g + b + c t

    The zero of the accelerometer is off by b (m/s^2) and moves by c (m/s^3). Neutral: b = c = 0.
    Source: Boore and Bommer (2005), Soil Dyn. Earthquake Eng. 25, 93-115. Fails first where the zero jumps during the shaking.
    """

    kind: Literal["baseline_drift"] = "baseline_drift"
    offset: float = quantity("Offset b", "m/s^2", "mm/s^2", ge=-10, le=10, default=0.0)
    rate: float = quantity("Rate c", "m/s^3", "mm/s^3", ge=-10, le=10, default=0.0)
    title: ClassVar[str] = "Baseline drift of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"offset": 0.0, "rate": 0.0}
    needs: ClassVar = ("ag",)
    relatives: ClassVar = ("scale_error",)
    noun: ClassVar[str] = "a drift of the baseline"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        size = 0.02 * seen.acceleration
        yield cls.sized(offset=size)
        yield cls.sized(rate=size / max(seen.time, seen.dt))

    def says(self) -> str:
        return f"has a baseline off by {said(self.offset, 'mm/s^2')} that drifts by {said(self.rate, 'mm/s^3')}"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        return ground + self.offset + self.rate * dt * np.arange(len(ground))
