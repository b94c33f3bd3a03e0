"""A ground motion without its high frequencies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class LowPass(Effect):
    """A ground motion without its high frequencies.

    T a' + a = a_g,  T = 1 / (2 pi f_c)

    The ground motion passed a first-order filter with the corner frequency f_c, in a shaking table or an amplifier. The step is
    exact for a_g that is linear between samples and zero before the first sample. Neutral: T = 0.
    Not valid for the steeper filters of digital recorders.
    """

    kind: Literal["low_pass"] = "low_pass"
    time_constant: float = quantity("Time constant T", "s", "ms", ge=0, le=10, default=0.0)
    title: ClassVar[str] = "Low-pass of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"time_constant": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        if self.time_constant == 0.0:
            return ground
        ratio = self.time_constant / dt
        decay = math.exp(-1 / ratio)
        mean = ratio * (1 - decay)
        numerator = [1 - mean, mean - decay]
        from scipy.signal import lfilter  # imported here: loading it takes 0.7 s

        passed: Array = lfilter(numerator, [1.0, -decay], ground)
        return passed


class LowPassSearch(Search[LowPass]):
    needs = ("ag",)
    relatives = ("scale_error", "time_shift")
    noun = "a low-pass filter of the ground motion"

    def guesses(self, seen: Seen) -> Iterator[LowPass]:
        for frequency in (3.0, 15.0):
            yield self.effect(time_constant=1 / (2 * math.pi * frequency))

    def says(self, effect: LowPass) -> str:
        corner = said(1 / (2 * math.pi * max(effect.time_constant, 1e-9)), "Hz")
        return f"lacks half of its power at {corner} and more at higher frequencies"
