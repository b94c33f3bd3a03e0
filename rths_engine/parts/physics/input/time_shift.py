"""A ground motion later or earlier than recorded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class TimeShift(Effect):
    """A ground motion later or earlier than recorded.

    a(t) = a_g(t - T)

    The ground motion comes T (s) later than recorded, or earlier for T < 0. Linear between samples; before the first sample and
    after the last one it keeps their value. Neutral: T = 0. Not valid where the clocks drift apart.
    """

    kind: Literal["time_shift"] = "time_shift"
    delay: float = quantity("Time shift T (positive: late)", "s", "ms", ge=-10, le=10, default=0.0)
    title: ClassVar[str] = "Time shift of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"delay": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        time = dt * np.arange(len(ground))
        shifted: Array = np.interp(time - self.delay, time, ground)
        return shifted


class TimeShiftSearch(Search[TimeShift]):
    needs = ("ag",)
    relatives = ("low_pass",)
    noun = "a time shift of the ground motion"

    def guesses(self, seen: Seen) -> Iterator[TimeShift]:
        yield self.effect(delay=0.01)

    def says(self, effect: TimeShift) -> str:
        return f"comes {said(abs(effect.delay), 'ms')} {'later' if effect.delay >= 0 else 'earlier'} than recorded"
