"""Force that is lost at one moment."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.gate import past
from rths_engine.parts.physics.search import EventSearch, Seen
from rths_engine.parts.physics.wording import said


class StrengthDrop(Effect):
    """Force that is lost at one moment.

    f = f_0 (1 - d [t > t_d])

    From t_d (s) on, the share d of the force is missing, because a seal, a bolt or a coil failed. Neutral: d = 0. No state.
    Not valid where the loss takes longer than the rise of the force.
    """

    kind: Literal["strength_drop"] = "strength_drop"
    share: float = quantity("Lost fraction d", "1", "%", ge=0, le=1, default=0.0)
    time: float = quantity("Time of the drop t_d", "s", ge=0, le=1e5, default=0.0)
    title: ClassVar[str] = "Strength drop"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.time]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y * (1.0 - p[0] * past(t, p[1], dt))


class StrengthDropSearch(EventSearch[StrengthDrop]):
    needs = ("x_meas", "f_meas")
    relatives = ("viscous_heating", "strength_degradation", "peak_degradation")
    proportional = True
    noun = "a strength drop"

    def guesses(self, seen: Seen) -> Iterator[StrengthDrop]:
        for part in (0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85):
            yield self.sized(share=0.1, time=part * seen.time)

    def says(self, effect: StrengthDrop) -> str:
        return f"loses {said(effect.share, '%')} of its force at {said(effect.time, 's')}"
