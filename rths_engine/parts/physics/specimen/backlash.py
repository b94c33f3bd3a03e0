"""Backlash between actuator and specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import INPUT, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class Backlash(Effect):
    """Backlash between actuator and specimen.

    |x - u| <= g/2;  u = x -+ g/2 in contact, which lasts while the specimen's force presses on it;  u rests between contacts

    The specimen's end u has free play g (m) in its connection. After a reversal the specimen unloads. Then the force stays zero
    until the piston has crossed the play. The force of the last substep decides when a contact opens. Neutral: g = 0.
    State: s[0] u, s[1] side in contact (1, -1 or 0), s[2] 1 after the first substep. At the start a force presses on one side,
    or the play is centred.
    Source: Nordin and Gutman (2002), Automatica 38, 1633-1649, the dead zone in series.
    Not valid where the play closes with an impact.
    """

    kind: Literal["backlash"] = "backlash"
    gap: float = quantity("Free play g", "m", "mm", ge=0, le=0.5, default=0.0)
    title: ClassVar[str] = "Backlash"
    hook: ClassVar[int] = INPUT
    neutral: ClassVar = {"gap": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.gap]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        half = 0.5 * p[0]
        if s[2] == 0.0:
            s[1] = 1.0 if w > 0.0 else -1.0 if w < 0.0 else 0.0
            s[0] = y - s[1] * half
            s[2] = 1.0
        if y - s[0] >= half or (s[1] > 0.0 and w > 0.0):
            s[0] = y - half
            s[1] = 1.0
        elif s[0] - y >= half or (s[1] < 0.0 and w < 0.0):
            s[0] = y + half
            s[1] = -1.0
        else:
            s[1] = 0.0
        return s[0]


class BacklashSearch(Search[Backlash]):
    needs = ("x_meas", "f_meas")
    relatives = ("series_compliance", "pinching")
    noun = "backlash"

    def guesses(self, seen: Seen) -> Iterator[Backlash]:
        for share in (0.01, 0.05, 0.2):
            yield self.sized(gap=share * seen.x)

    def says(self, effect: Backlash) -> str:
        return f"moves {said(effect.gap, 'mm')} without force after each reversal"
