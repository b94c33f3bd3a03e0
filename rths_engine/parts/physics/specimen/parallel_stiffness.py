"""A spring beside the specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect, Seen
from rths_engine.parts.physics.wording import said


class ParallelStiffness(Effect):
    """f = f_0 + k x

    k (N/m) of either sign: an accumulator, a gas charge, a guide; a negative one takes stiffness away. Neutral: k = 0.
    No state. Fails first where the spring hardens with its stroke.
    """

    kind: Literal["parallel_stiffness"] = "parallel_stiffness"
    stiffness: float = quantity("Stiffness k", "N/m", "kN/m", ge=-1e12, le=1e12, default=0.0)
    title: ClassVar[str] = "Parallel stiffness"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"stiffness": 0.0}
    needs: ClassVar = ("x_meas", "f_meas")
    relatives: ClassVar = ("cubic_stiffness", "added_inertia")
    noun: ClassVar[str] = "a stiffness in parallel"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        yield cls.sized(stiffness=0.1 * seen.stiffness)

    def says(self) -> str:
        way = "more" if self.stiffness >= 0 else "less"
        return f"has {said(abs(self.stiffness), 'kN/m')} {way} stiffness than its model"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * x
