"""Force that wears away with the dissipated energy, down to a share that stays."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class StrengthDegradation(Effect):
    """Force that wears away with the dissipated energy, down to a share that stays.

    f = f_0 (1 - d (1 - exp(-E / E_d))),  E' = f v

    E (J) is the work done on the specimen so far; all of it is dissipated except the energy that springs return. d is the share
    of the force that is lost in the end, E_d (J) the energy after which 63 % of that share is lost. E follows the trapezoidal
    rule. Neutral: d = 0. State: s[0] E, s[1] x and s[2] f of the last substep, s[3] 1 after the first substep.
    Source: the index of dissipated energy of Ibarra, Medina and Krawinkler (2005), EESD 34, 1489-1511, with an exponential law.
    Not valid where the strength returns at rest, as that of a fluid that cools.
    """

    kind: Literal["strength_degradation"] = "strength_degradation"
    share: float = quantity("Share of the force lost in the end d", "1", "%", ge=0, le=0.99, default=0.0)
    energy: float = quantity("Energy of degradation E_d", "J", "kJ", gt=0, le=1e12, default=1e3)
    title: ClassVar[str] = "Strength degradation with energy"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.energy]), np.zeros(4)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        force = y * (1.0 - p[0] * (1.0 - math.exp(-max(s[0], 0.0) / p[1])))
        if s[3] > 0.0:
            s[0] += 0.5 * (force + s[2]) * (x - s[1])
        s[1] = x
        s[2] = force
        s[3] = 1.0
        return force


class StrengthDegradationSearch(Search[StrengthDegradation]):
    needs = ("x_meas", "f_meas")
    relatives = ("viscous_heating", "peak_degradation", "stiffness_degradation", "strength_drop")
    noun = "strength degradation with dissipated energy"

    def guesses(self, seen: Seen) -> Iterator[StrengthDegradation]:
        yield self.sized(share=0.4, energy=0.3 * seen.energy)

    def says(self, effect: StrengthDegradation) -> str:
        share, energy = said(effect.share, "%"), said(math.log(2) * effect.energy, "kJ")
        return f"loses {share} of its force as it dissipates energy, half of that within the first {energy}"
