"""A storey that loses stiffness at one moment."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.gate import past
from rths_engine.parts.physics.search import EventSearch, Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class StiffnessDrop(OfStorey):
    """A storey that loses stiffness at one moment.

    f = -d w [t > t_d]

    From t_d (s) on, the share d of the storey's elastic force w is missing, because a brace or a weld failed. Neutral: d = 0.
    No state. Not valid where the failure leaves a permanent drift.
    """

    kind: Literal["stiffness_drop"] = "stiffness_drop"
    share: float = quantity("Lost fraction d", "1", "%", ge=0, le=0.95, default=0.0)
    time: float = quantity("Time of the drop t_d", "s", ge=0, le=1e5, default=0.0)
    title: ClassVar[str] = "Stiffness drop"
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.time]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y - p[0] * w * past(t, p[1], dt)


class StiffnessDropSearch(StoreySearch[StiffnessDrop], EventSearch[StiffnessDrop]):
    relatives = ("stiffness_error", "yielding", "softening", "stiffness_degradation")
    noun = "a stiffness drop"

    def guesses(self, seen: Seen) -> Iterator[StiffnessDrop]:
        for part in (0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85):
            yield self.sized(share=0.1, time=part * seen.time).model_copy(update={"storey": seen.storey})

    def says(self, effect: StiffnessDrop) -> str:
        return f"loses {said(effect.share, '%')} of its stiffness at {said(effect.time, 's')}"
