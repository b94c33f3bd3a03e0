"""A piston that sticks after each reversal."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import PISTON, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class StickFriction(Effect):
    """A piston that sticks after each reversal.

    y rests after a reversal until |d - y| = b;  then y = d + o,  o' = -o / tau from o = -+ b

    At every reversal of the drive d, seals hold the piston y until d is b (m) ahead. Then the piston catches up with the time
    constant tau (s). Neutral: b = 0. State: s[0] y, s[1] d of the last substep, s[2] direction of motion (1, -1 or 0), s[3] o,
    s[4] 1 while the piston sticks, s[5] 1 after the first substep.
    Source: stiction of Armstrong-Helouvry, Dupont and Canudas de Wit (1994), Automatica 30, 1083-1138, as a displacement.
    Not valid where a force on the piston helps to release it.
    """

    kind: Literal["stick_friction"] = "stick_friction"
    breakaway: float = quantity("Breakaway displacement b", "m", "mm", ge=0, le=0.1, default=0.0)
    catching: float = quantity("Catch-up time τ", "s", "ms", gt=0, le=1, default=0.02)
    title: ClassVar[str] = "Stick friction"
    hook: ClassVar[int] = PISTON
    neutral: ClassVar = {"breakaway": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.breakaway, math.exp(-dt / self.catching)]), np.zeros(6)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[5] == 0.0:
            s[0], s[1], s[5] = y, y, 1.0
        move = y - s[1]
        s[1] = y
        if move * s[2] < 0.0:
            s[4] = 1.0
        if move != 0.0:
            s[2] = 1.0 if move > 0.0 else -1.0
        ahead = y - s[0]
        if s[4] == 0.0:
            s[3] *= p[1]
        elif abs(ahead) >= p[0]:
            s[3] = -p[0] if ahead > 0.0 else p[0]
            s[4] = 0.0
        else:
            return s[0]
        s[0] = y + s[3]
        return s[0]


class StickFrictionSearch(Search[StickFriction]):
    needs = ("x_comp", "x_meas")
    relatives = ("backlash", "dead_band")
    noun = "stick friction"

    def guesses(self, seen: Seen) -> Iterator[StickFriction]:
        for share in (0.01, 0.05):
            yield self.sized(breakaway=share * seen.x)

    def says(self, effect: StickFriction) -> str:
        return f"sticks at each reversal until its drive is {said(effect.breakaway, 'mm')} ahead"
