"""Force that is lost with the largest displacement so far."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import lost


class PeakDegradation(Effect):
    """Force that is lost with the largest displacement so far.

    f = f_0 exp(-kappa m),  m = the largest |x| so far

    kappa (1/m) is the share of the force that is lost for each metre of the largest displacement, at its beginning. The force
    stays above zero and does not come back. Neutral: kappa = 0. State: s[0] m.
    Source: damage by the largest deformation, Park and Ang (1985), J. Struct. Eng. 111, 722-739, as an exponential.
    Not valid where damage begins only beyond a displacement.
    """

    kind: Literal["peak_degradation"] = "peak_degradation"
    rate: float = quantity("Force loss per largest displacement κ", "1/m", "1/mm", ge=0, le=1e6, default=0.0)
    title: ClassVar[str] = "Strength degradation with peak displacement"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"rate": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.rate]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        s[0] = max(s[0], abs(x))
        return y * math.exp(-p[0] * s[0])


class PeakDegradationSearch(Search[PeakDegradation]):
    needs = ("x_meas", "f_meas")
    relatives = ("strength_degradation", "strength_drop", "pinching")
    noun = "strength degradation with peak displacement"

    def guesses(self, seen: Seen) -> Iterator[PeakDegradation]:
        yield self.sized(rate=0.3 / max(seen.x, TINY))

    def says(self, effect: PeakDegradation) -> str:
        share, unit = lost(effect.rate, "mm")
        return f"loses {share} of its force for every {unit} of its largest displacement so far"
