"""A piston that moves more or less than commanded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import PISTON, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class GainError(Effect):
    """A piston that moves more or less than commanded.

    y = (1 + e) d

    e has either sign. Causes are a position loop without an integral part, or a calibration with a different transducer.
    Neutral: e = 0. No state.
    Not valid where the gain depends on the frequency.
    """

    kind: Literal["gain_error"] = "gain_error"
    share: float = quantity("Gain error e", "1", "%", ge=-0.9, le=1, default=0.0)
    title: ClassVar[str] = "Gain error"
    hook: ClassVar[int] = PISTON
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return (1.0 + p[0]) * y


class GainErrorSearch(Search[GainError]):
    needs = ("x_comp", "x_meas")
    relatives = ("force_compliance", "scale_error")
    noun = "a gain error"

    def guesses(self, seen: Seen) -> Iterator[GainError]:
        yield self.effect(share=0.02)

    def says(self, effect: GainError) -> str:
        way = "further" if effect.share >= 0 else "less"
        return f"moves {said(abs(effect.share), '%')} {way} than commanded"
