"""A storey that strikes a stop."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class GapContact(OfStorey):
    """A storey that strikes a stop.

    f = k_c (x - g) for x > g,  k_c (x + g) for x < -g

    Beyond the drift g (m) the storey touches a stop or a neighbouring building of stiffness k_c (N/m), on both sides or on one.
    No energy is lost. Neutral: k_c = 0. No state.
    Source: the linear spring element of Anagnostopoulos (1988), EESD 16, 443-456.
    Not valid where impacts dissipate energy, or where the stop is so stiff that a contact lasts only a few integration steps.
    """

    kind: Literal["gap_contact"] = "gap_contact"
    gap: float = quantity("Gap g", "m", "mm", ge=0, le=10, default=0.0)
    stiffness: float = quantity("Contact stiffness k_c", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    side: Literal["both", "positive", "negative"] = Field("both", title="Side")
    title: ClassVar[str] = "Gap and contact"
    neutral: ClassVar = {"stiffness": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.gap, self.stiffness, self.side != "negative", self.side != "positive"]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[1] * (p[2] * max(x - p[0], 0.0) + p[3] * min(x + p[0], 0.0))


class GapContactSearch(StoreySearch[GapContact]):
    relatives = ("cubic_stiffness", "pinching")
    noun = "contact after a gap"

    def guesses(self, seen: Seen) -> Iterator[GapContact]:
        guess = self.sized(gap=0.7 * seen.x, stiffness=0.5 * seen.stiffness)
        for side in ("both", "positive", "negative"):
            yield guess.model_copy(update={"storey": seen.storey, "side": side})
        # stiff stops keep the drift far below that of the planned model, which `seen` is of
        yield self.sized(gap=0.4 * seen.x, stiffness=2.0 * seen.stiffness).model_copy(update={"storey": seen.storey})

    def says(self, effect: GapContact) -> str:
        where = {"both": "both sides", "positive": "the positive side", "negative": "the negative side"}[effect.side]
        return f"strikes a stop of {said(effect.stiffness, 'kN/m')} after {said(effect.gap, 'mm')} on {where}"
