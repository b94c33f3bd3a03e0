"""A stop beyond a gap that hardens as it is pressed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class GapContact(Effect):
    """A stop beyond a gap that hardens as it is pressed.

    f = f_0 + k_c d (1 + h d) for x > g with d = x - g; for x < -g mirrored

    Beyond the displacement g (m) the specimen touches a stop of stiffness k_c (N/m), on both sides or on one; h (1/m) is the
    share by which the stop's secant stiffness grows for each metre. No energy is lost. Neutral: k_c = 0. No state.
    Source: Jankowski (2005), EESD 34, 595-611, with a polynomial in place of the power 3/2. Not valid where impacts dissipate.
    """

    kind: Literal["gap_contact"] = "gap_contact"
    gap: float = quantity("Gap g", "m", "mm", ge=0, le=10, default=0.0)
    stiffness: float = quantity("Contact stiffness k_c", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    hardening: float = quantity("Hardening of the contact h", "1/m", "1/mm", ge=0, le=1e6, default=0.0)
    side: Literal["both", "positive", "negative"] = Field("both", title="Side")
    title: ClassVar[str] = "Gap and hardening stop"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"stiffness": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.gap, self.stiffness, self.hardening, self.side != "negative", self.side != "positive"]), np.zeros(
            1
        )

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        ahead, behind = p[3] * max(x - p[0], 0.0), p[4] * max(-x - p[0], 0.0)
        return y + p[1] * (ahead * (1.0 + p[2] * ahead) - behind * (1.0 + p[2] * behind))


class GapContactSearch(Search[GapContact]):
    needs = ("x_meas", "f_meas")
    relatives = ("cubic_stiffness", "pinching")
    proportional = True
    noun = "contact after a gap"

    def guesses(self, seen: Seen) -> Iterator[GapContact]:
        guess = self.sized(gap=0.6 * seen.x, stiffness=0.5 * seen.stiffness, hardening=1 / max(seen.x, TINY))
        for side in ("both", "positive", "negative"):
            yield guess.model_copy(update={"side": side})

    def says(self, effect: GapContact) -> str:
        where = {"both": "both sides", "positive": "the positive side", "negative": "the negative side"}[effect.side]
        return f"strikes a stop of {said(effect.stiffness, 'kN/m')} after {said(effect.gap, 'mm')} on {where}"
