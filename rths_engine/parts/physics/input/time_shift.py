"""A ground motion later or earlier than recorded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect, Seen
from rths_engine.parts.physics.wording import said


class TimeShift(Effect):
    """a(t) = a_g(t - T)

    The ground motion comes T (s) later than recorded, earlier for T < 0; linear between samples, the first and the last value
    beyond them. Neutral: T = 0. Fails first where the clocks drift apart.
    """

    kind: Literal["time_shift"] = "time_shift"
    delay: float = quantity("Time shift T, positive where late", "s", "ms", ge=-10, le=10, default=0.0)
    title: ClassVar[str] = "Time shift of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"delay": 0.0}
    needs: ClassVar = ("ag",)
    relatives: ClassVar = ("low_pass",)
    noun: ClassVar[str] = "a time shift of the ground motion"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        yield cls(delay=0.01)

    def says(self) -> str:
        return f"comes {said(abs(self.delay), 'ms')} {'later' if self.delay >= 0 else 'earlier'} than recorded"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        time = dt * np.arange(len(ground))
        shifted: Array = np.interp(time - self.delay, time, ground)
        return shifted
