"""A spring beside the specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class ParallelStiffness(Effect):
    """A spring beside the specimen.

    f = f_0 + k x

    k (N/m) has either sign. Causes are an accumulator, a gas charge or a guide. Neutral: k = 0. No state.
    Not valid where the spring hardens with its stroke.
    """

    kind: Literal["parallel_stiffness"] = "parallel_stiffness"
    stiffness: float = quantity("Stiffness k", "N/m", "kN/m", ge=-1e12, le=1e12, default=0.0)
    title: ClassVar[str] = "Parallel stiffness"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"stiffness": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * x


class ParallelStiffnessSearch(Search[ParallelStiffness]):
    needs = ("x_meas", "f_meas")
    relatives = ("cubic_stiffness", "added_inertia", "pendulum_friction")
    proportional = True
    noun = "a parallel stiffness"

    def guesses(self, seen: Seen) -> Iterator[ParallelStiffness]:
        yield self.sized(stiffness=0.1 * seen.stiffness)

    def says(self, effect: ParallelStiffness) -> str:
        way = "more" if effect.stiffness >= 0 else "less"
        return f"has {said(abs(effect.stiffness), 'kN/m')} {way} stiffness than its model"
