"""Force that is lost at one moment."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect, Seen
from rths_engine.parts.physics.gate import past
from rths_engine.parts.physics.wording import said


class StrengthDrop(Effect):
    """f = f_0 (1 - d [t > t_d])

    From the moment t_d (s) the share d of the force is missing: a seal, a bolt or a coil has failed. Neutral: d = 0. No state.
    Fails first where the loss takes longer than the rise of the force.
    """

    kind: Literal["strength_drop"] = "strength_drop"
    share: float = quantity("Share lost d", "1", "%", ge=0, le=1, default=0.0)
    time: float = quantity("Moment t_d", "s", ge=0, le=1e5, default=0.0)
    title: ClassVar[str] = "Strength drop"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"share": 0.0}
    needs: ClassVar = ("x_meas", "f_meas")
    relatives: ClassVar = ("viscous_heating",)
    noun: ClassVar[str] = "a drop of the strength"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        for part in (0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85):
            yield cls.sized(share=0.1, time=part * seen.time)

    def says(self) -> str:
        return f"loses {said(self.share, '%')} of its force at {said(self.time, 's')}"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.time]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y * (1.0 - p[0] * past(t, p[1], dt))
