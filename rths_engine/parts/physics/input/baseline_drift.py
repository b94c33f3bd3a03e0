"""A ground motion whose baseline moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class BaselineDrift(Effect):
    """A ground motion whose baseline moves.

    a = a_g + b + c t

    The zero of the accelerometer is off by b (m/s^2) and moves by c (m/s^3). Neutral: b = c = 0.
    Source: Boore and Bommer (2005), Soil Dyn. Earthquake Eng. 25, 93-115. Not valid where the zero jumps during the shaking.
    """

    kind: Literal["baseline_drift"] = "baseline_drift"
    offset: float = quantity("Offset b", "m/s^2", "mm/s^2", ge=-10, le=10, default=0.0)
    rate: float = quantity("Rate c", "m/s^3", "mm/s^3", ge=-10, le=10, default=0.0)
    title: ClassVar[str] = "Baseline drift of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"offset": 0.0, "rate": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        return ground + self.offset + self.rate * dt * np.arange(len(ground))


class BaselineDriftSearch(Search[BaselineDrift]):
    needs = ("ag",)
    relatives = ("scale_error",)
    noun = "baseline drift"

    def guesses(self, seen: Seen) -> Iterator[BaselineDrift]:
        size = 0.02 * seen.acceleration
        yield self.sized(offset=size)
        yield self.sized(rate=size / max(seen.time, seen.dt))

    def says(self, effect: BaselineDrift) -> str:
        return f"has a baseline offset of {said(effect.offset, 'mm/s^2')} and a baseline drift of {said(effect.rate, 'mm/s^3')}"
