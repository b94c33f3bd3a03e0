"""Strength that differs between the two directions of force."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class Asymmetry(Effect):
    """Strength that differs between the two directions of force.

    f = (1 + a) f_0 for f_0 > 0, (1 - a) f_0 for f_0 < 0

    Neutral: a = 0. Not valid where the asymmetry depends on the displacement and not on the force.
    """

    kind: Literal["asymmetry"] = "asymmetry"
    share: float = quantity("Asymmetry a", "1", "%", ge=-0.9, le=0.9, default=0.0)
    title: ClassVar[str] = "Asymmetry"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y * (1.0 + p[0]) if y > 0.0 else y * (1.0 - p[0])


class AsymmetrySearch(Search[Asymmetry]):
    needs = ("x_meas", "f_meas")
    relatives = ("offset", "asymmetric_viscosity")
    proportional = True
    noun = "strength asymmetry"

    def guesses(self, seen: Seen) -> Iterator[Asymmetry]:
        yield self.effect(share=0.1)

    def says(self, effect: Asymmetry) -> str:
        way, other = ("positive", "negative") if effect.share > 0 else ("negative", "positive")
        share = said(abs(effect.share), "%")
        return f"is {share} stronger than its average in {way} force, and {share} weaker in {other} force"
