"""A storey that yields."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class Yielding(OfStorey):
    """A storey that yields.

    f = (1 - r) (q - w),  q' = w' while |q| < F_y or w turns it back

    w is the elastic force of the storey. The total force is r w + (1 - r) q: bilinear with kinematic hardening, yield force
    F_y (N) and post-yield stiffness r times the initial stiffness. Exact for a drift that reverses at substeps. Neutral: r = 1.
    State: s[0] q, s[1] w of the last substep, s[2] 1 after the first substep.
    Source: Chopra, Dynamics of Structures, chapter 7. Not valid where strength or stiffness degrades.
    """

    kind: Literal["yielding"] = "yielding"
    yield_force: float = quantity("Yield force F_y", "N", "kN", gt=0, le=1e12, default=1e12)
    post_yield_ratio: float = quantity("Post-yield stiffness ratio r", "1", "%", ge=0, le=1, default=1.0)
    title: ClassVar[str] = "Yielding"
    neutral: ClassVar = {"post_yield_ratio": 1.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.yield_force, 1 - self.post_yield_ratio]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] == 0.0:
            s[0], s[1], s[2] = w, w, 1.0
        s[0] = min(max(s[0] + (w - s[1]), -p[0]), p[0])
        s[1] = w
        return y + p[1] * (s[0] - w)


class YieldingSearch(StoreySearch[Yielding]):
    relatives = ("bouc_wen_hysteresis", "coulomb_friction", "softening", "self_centring")
    noun = "yielding"

    def guesses(self, seen: Seen) -> Iterator[Yielding]:
        for share in (0.5, 0.8):
            guess = self.sized(yield_force=share * seen.f, post_yield_ratio=0.3)
            yield guess.model_copy(update={"storey": seen.storey})

    def says(self, effect: Yielding) -> str:
        return f"yields at {said(effect.yield_force, 'kN')} and keeps {said(effect.post_yield_ratio, '%')} of its stiffness"
