"""Backlash between drive and piston."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import PISTON, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class Backlash(Effect):
    """Backlash between drive and piston.

    y = min(max(y[q-1], d - g/2), d + g/2)

    The play operator: the piston's end y follows the drive d with free play g (m). After a reversal y rests while the drive
    crosses the play. Neutral: g = 0. State: s[0] y, s[1] 1 after the first substep. At the start the play is centred.
    Source: Brokate and Sprekels (1996), "Hysteresis and Phase Transitions", Springer, section 2.2.
    Not valid where the force of the specimen pushes the piston through the play.
    """

    kind: Literal["backlash"] = "backlash"
    gap: float = quantity("Free play g", "m", "mm", ge=0, le=0.5, default=0.0)
    title: ClassVar[str] = "Backlash of the actuator"
    hook: ClassVar[int] = PISTON
    neutral: ClassVar = {"gap": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([0.5 * self.gap]), np.zeros(2)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[1] == 0.0:
            s[0] = y
            s[1] = 1.0
        s[0] = min(max(s[0], y - p[0]), y + p[0])
        return s[0]


class BacklashSearch(Search[Backlash]):
    needs = ("x_comp", "x_meas")
    relatives = ("dead_band", "stick_friction", "delay_error")
    noun = "backlash"

    def guesses(self, seen: Seen) -> Iterator[Backlash]:
        for share in (0.01, 0.05):
            yield self.sized(gap=share * seen.x)

    def says(self, effect: Backlash) -> str:
        return f"rests after each reversal while its drive moves {said(effect.gap, 'mm')}"
