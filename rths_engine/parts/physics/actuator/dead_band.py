"""A drive that does not correct small errors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import COMMAND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class DeadBand(Effect):
    """A drive that does not correct small errors.

    y = x + e - clip(e, -b, b),  e = d - x

    The drive reacts only to the part of the error e between command d and piston x that exceeds b (m), as with an overlapped
    valve. The piston rests while |e| <= b; beyond that it lags by b more. Neutral: b = 0. No state.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley, overlapped spools. Not valid where dither bridges the overlap.
    """

    kind: Literal["dead_band"] = "dead_band"
    half_width: float = quantity("Half width b", "m", "mm", ge=0, le=0.1, default=0.0)
    title: ClassVar[str] = "Dead band"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"half_width": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.half_width]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        error = y - x
        if abs(error) <= p[0]:
            return x
        return y - p[0] if error > 0.0 else y + p[0]


class DeadBandSearch(Search[DeadBand]):
    needs = ("x_comp", "x_meas")
    relatives = ("backlash", "stick_friction")
    noun = "a dead band"

    def guesses(self, seen: Seen) -> Iterator[DeadBand]:
        for share in (0.01, 0.05):
            yield self.sized(half_width=share * seen.x)

    def says(self, effect: DeadBand) -> str:
        return f"does not react to errors smaller than {said(effect.half_width, 'mm')}"
