"""A storey whose stiffness falls with the amplitude of its drift."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class Softening(OfStorey):
    """A storey whose stiffness falls with the amplitude of its drift.

    f = -d w |x| / (|x| + x_s)

    At small drifts the storey has its elastic force w; at drifts far above x_s (m) the share d of it is missing. The stiffness
    returns with small drifts, so that the frequency of a free vibration rises as it decays. Neutral: d = 0. No state.
    Source: amplitude-dependent frequencies of buildings, Clinton et al. (2006), Bull. Seism. Soc. Am. 96, 237-257.
    Not valid where the stiffness returns only after a rest, or where the softening dissipates energy.
    """

    kind: Literal["softening"] = "softening"
    share: float = quantity("Share of the stiffness lost at large drifts d", "1", "%", ge=0, le=0.95, default=0.0)
    drift: float = quantity("Drift of the softening x_s", "m", "mm", gt=0, le=10, default=5e-3)
    title: ClassVar[str] = "Softening with amplitude"
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share, self.drift]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y - p[0] * w * abs(x) / (abs(x) + p[1])


class SofteningSearch(StoreySearch[Softening]):
    relatives = ("cubic_stiffness", "yielding", "self_centring", "stiffness_degradation", "stiffness_drop")
    noun = "softening with amplitude"

    def guesses(self, seen: Seen) -> Iterator[Softening]:
        yield self.sized(share=0.2, drift=0.3 * seen.x).model_copy(update={"storey": seen.storey})

    def says(self, effect: Softening) -> str:
        share, drift = said(effect.share, "%"), said(effect.drift, "mm")
        return f"loses up to {share} of its stiffness at large drifts, half of that at {drift}, and regains it at small drifts"
