"""A storey that loses stiffness with the work that its elastic force has done."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class StiffnessDegradation(OfStorey):
    """A storey that loses stiffness with the work that its elastic force has done.

    f = -d w (1 - exp(-E / E_d)),  E' = |w v|

    w is the elastic force of the storey and E (J) the sum of the magnitudes of its work: a cycle of amplitude X adds 2 k X^2.
    d is the share of the stiffness that is lost in the end, E_d (J) the work after which 63 % of that share is lost. E follows
    the trapezoidal rule. Neutral: d = 0. State: s[0] E, s[1] x and s[2] w of the last substep, s[3] 1 after the first substep.
    Source: the stiffness degradation of Baber and Wen (1981), J. Eng. Mech. Div. ASCE 107, 1069-1087, with a bounded law.
    Not valid where the loss follows the largest drift alone.
    """

    kind: Literal["stiffness_degradation"] = "stiffness_degradation"
    share: float = quantity("Share of the stiffness lost in the end d", "1", "%", ge=0, le=0.95, default=0.0)
    energy: float = quantity("Work of degradation E_d", "J", "kJ", gt=0, le=1e15, default=1e3)
    title: ClassVar[str] = "Stiffness degradation with energy"
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.energy]), np.zeros(4)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[3] > 0.0:
            s[0] += 0.5 * abs((w + s[2]) * (x - s[1]))
        s[1] = x
        s[2] = w
        s[3] = 1.0
        return y - p[0] * w * (1.0 - math.exp(-s[0] / p[1]))


class StiffnessDegradationSearch(StoreySearch[StiffnessDegradation]):
    relatives = ("stiffness_drop", "softening", "yielding")
    noun = "stiffness degradation with energy"

    def guesses(self, seen: Seen) -> Iterator[StiffnessDegradation]:
        yield self.sized(share=0.2, energy=10 * seen.energy).model_copy(update={"storey": seen.storey})

    def says(self, effect: StiffnessDegradation) -> str:
        share, energy = said(effect.share, "%"), said(math.log(2) * effect.energy, "kJ")
        return f"loses {share} of its stiffness as it works, half of that within the first {energy}"
