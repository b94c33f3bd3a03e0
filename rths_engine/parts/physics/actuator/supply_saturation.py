"""A hydraulic supply whose reserve is used up by a long fast motion."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import PISTON, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class SupplySaturation(Effect):
    """A hydraulic supply whose reserve is used up by a long fast motion.

    |y'| <= v_p while R = 0,  R' = v_p - |y'| within 0 <= R <= R_0

    The pump moves the piston at most with v_p (m/s) for any length of time. An accumulator moves it on by R_0 (m), and is filled
    again while the piston is slower than v_p. Without a reserve this is velocity saturation. Neutral: v_p = 10 m/s, above the
    limit of every actuator here. State: s[0] y, s[1] R, s[2] 1 after the first substep.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley, chapter 11. Not valid where other drives use the same supply.
    """

    kind: Literal["supply_saturation"] = "supply_saturation"
    velocity: float = quantity("Sustained velocity v_p", "m/s", "mm/s", gt=0, le=10, default=10.0)
    reserve: float = quantity("Reserve of the accumulator R_0", "m", "mm", ge=0, le=100, default=0.0)
    title: ClassVar[str] = "Supply saturation"
    hook: ClassVar[int] = PISTON
    neutral: ClassVar = {"velocity": 10.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.velocity * dt, self.reserve]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] == 0.0:
            s[0], s[1], s[2] = y, p[1], 1.0
        most = p[0] + s[1]
        move = min(max(y - s[0], -most), most)
        s[0] += move
        s[1] = min(max(s[1] + p[0] - abs(move), 0.0), p[1])
        return s[0]


class SupplySaturationSearch(Search[SupplySaturation]):
    needs = ("x_comp", "x_meas")
    relatives = ("velocity_saturation", "valve_flow")
    noun = "saturation of the hydraulic supply"

    def guesses(self, seen: Seen) -> Iterator[SupplySaturation]:
        for share in (0.3, 0.6):
            yield self.sized(velocity=share * seen.v, reserve=0.5 * seen.x)

    def says(self, effect: SupplySaturation) -> str:
        velocity, reserve = said(effect.velocity, "mm/s"), said(effect.reserve, "mm")
        return f"moves faster than {velocity} only until it has used a reserve of {reserve}"
