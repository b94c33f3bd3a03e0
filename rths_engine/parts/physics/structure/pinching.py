"""A storey that slips about the middle of its drift."""

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


class Pinching(OfStorey):
    """A storey that slips about the middle of its drift.

    f = -d w exp(-(x / x_p)^2)

    The share d of the storey's elastic force w is missing at the drift x = 0; x_p (m) is half the width of the pinch. Causes
    are bolts that slip in their holes and cracks that must close. Neutral: d = 0. No state.
    Source: the Gaussian slip zone of Baber and Noori (1985), J. Eng. Mech. 111, 1010-1026, without its dissipation.
    Not valid where the slip grows with the largest drift so far.
    """

    kind: Literal["pinching"] = "pinching"
    depth: float = quantity("Pinching depth d", "1", "%", ge=0, le=0.99, default=0.0)
    width: float = quantity("Pinching half width x_p", "m", "mm", gt=0, le=1, default=5e-3)
    title: ClassVar[str] = "Pinching of a storey"
    neutral: ClassVar = {"depth": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.depth, self.width]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        ratio = x / p[1]
        return y - p[0] * w * math.exp(-ratio * ratio)


class PinchingSearch(StoreySearch[Pinching]):
    relatives = ("cubic_stiffness", "gap_contact")
    noun = "pinching"

    def guesses(self, seen: Seen) -> Iterator[Pinching]:
        for share in (0.15, 0.5):
            yield self.sized(depth=0.3, width=share * seen.x).model_copy(update={"storey": seen.storey})

    def says(self, effect: Pinching) -> str:
        return f"loses {said(effect.depth, '%')} of its force within {said(effect.width, 'mm')} of the middle of its drift"
