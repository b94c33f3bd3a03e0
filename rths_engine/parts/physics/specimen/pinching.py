"""Force that is reduced about the middle of the stroke."""

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


class Pinching(Effect):
    """Force that is reduced about the middle of the stroke.

    f = f_0 (1 - d exp(-(x / x_p)^2))

    d is the share of the force that is lost at x = 0, and x_p (m) is half the width of the pinch. Neutral: d = 0. No state.
    Source: the Gaussian slip zone of Baber and Noori (1985), J. Eng. Mech. 111, 1010-1026, applied to the force.
    Not valid where the pinch moves with the force or with the largest displacement so far.
    """

    kind: Literal["pinching"] = "pinching"
    depth: float = quantity("Pinching depth d", "1", "%", ge=0, le=0.99, default=0.0)
    width: float = quantity("Pinching half width x_p", "m", "mm", gt=0, le=1, default=5e-3)
    title: ClassVar[str] = "Pinching"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"depth": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.depth, self.width]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        ratio = x / p[1]
        return y * (1.0 - p[0] * math.exp(-ratio * ratio))


class PinchingSearch(Search[Pinching]):
    needs = ("x_meas", "f_meas")
    relatives = ("backlash", "cubic_stiffness", "self_centring")
    proportional = True
    noun = "pinching"

    def guesses(self, seen: Seen) -> Iterator[Pinching]:
        for share in (0.1, 0.4):
            yield self.sized(depth=0.3, width=share * seen.x)

    def says(self, effect: Pinching) -> str:
        return f"loses {said(effect.depth, '%')} of its force within {said(effect.width, 'mm')} of the middle of its stroke"
