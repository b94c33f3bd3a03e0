"""Stiffness that is lost with the dissipated energy, while the strength stays."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import INPUT, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class StiffnessDegradation(Effect):
    """Stiffness that is lost with the dissipated energy, while the strength stays.

    f = f_0(u),  u = x (1 - d (1 - exp(-E / E_d))),  E' = f x'

    The specimen needs more displacement for the same force: u is the part of the displacement x that its law feels. d is the
    share of the stiffness that is lost in the end, E_d (J) the energy after which 63 % of that share is lost. The force of the
    last substep gives E. Neutral: d = 0. State: s[0] E, s[1] x of the last substep, s[2] 1 after the first substep.
    Source: the stiffness degradation of Baber and Wen (1981), J. Eng. Mech. Div. ASCE 107, 1069-1087, with a bounded law.
    Not valid for a linear specimen, where it is strength degradation, and where the strength is lost too.
    """

    kind: Literal["stiffness_degradation"] = "stiffness_degradation"
    share: float = quantity("Share of the stiffness lost in the end d", "1", "%", ge=0, le=0.95, default=0.0)
    energy: float = quantity("Energy of degradation E_d", "J", "kJ", gt=0, le=1e12, default=1e3)
    title: ClassVar[str] = "Stiffness degradation with energy"
    hook: ClassVar[int] = INPUT
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.energy]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] > 0.0:
            s[0] += w * (y - s[1])
        s[1] = y
        s[2] = 1.0
        return y * (1.0 - p[0] * (1.0 - math.exp(-max(s[0], 0.0) / p[1])))


class StiffnessDegradationSearch(Search[StiffnessDegradation]):
    needs = ("x_meas", "f_meas")
    relatives = ("strength_degradation", "viscous_heating", "backlash")
    noun = "stiffness degradation with dissipated energy"

    def guesses(self, seen: Seen) -> Iterator[StiffnessDegradation]:
        yield self.sized(share=0.4, energy=0.3 * seen.energy)

    def says(self, effect: StiffnessDegradation) -> str:
        share, energy = said(effect.share, "%"), said(math.log(2) * effect.energy, "kJ")
        return f"loses {share} of its stiffness as it dissipates energy, half of that within the first {energy}"
