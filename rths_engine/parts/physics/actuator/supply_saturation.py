"""A hydraulic supply whose pressure falls as its accumulator empties."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import COMMAND, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class SupplySaturation(Effect):
    """A hydraulic supply whose pressure falls as its accumulator empties.

    y = x + e sqrt(max(1 - rho D, 0)),  e = d - x,  D' = |v| - v_p, D >= 0

    The pump alone moves the piston with v_p (m/s). A faster motion draws the way D (m) from the accumulator, a slower motion
    fills it again; at D = 1 / rho the supply is used up. The flow of the valve grows with the square root of the pressure,
    so that the drive feels only this part of the error e between the command d and the piston x. Neutral: rho = 0.
    State: s[0] D.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley, chapters 5 and 11. Not valid where other drives use the supply.
    """

    kind: Literal["supply_saturation"] = "supply_saturation"
    emptying: float = quantity("Pressure loss per drawn way ρ", "1/m", "1/mm", ge=0, le=1e6, default=0.0)
    velocity: float = quantity("Sustained velocity v_p", "m/s", "mm/s", ge=0, le=10, default=0.1)
    title: ClassVar[str] = "Supply saturation"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"emptying": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.emptying, self.velocity]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        s[0] = max(s[0] + (abs(v) - p[1]) * dt, 0.0)
        return x + (y - x) * math.sqrt(max(1.0 - p[0] * s[0], 0.0))


class SupplySaturationSearch(Search[SupplySaturation]):
    needs = ("x_comp", "x_meas")
    relatives = ("velocity_saturation", "valve_flow", "amplitude_dependent_delay")
    noun = "saturation of the hydraulic supply"

    def guesses(self, seen: Seen) -> Iterator[SupplySaturation]:
        for share in (0.3, 0.6):
            yield self.sized(emptying=0.3 / max(seen.x, TINY), velocity=share * seen.v)

    def says(self, effect: SupplySaturation) -> str:
        velocity, reserve = said(effect.velocity, "mm/s"), said(1 / max(effect.emptying, TINY), "mm")
        return f"weakens as it moves faster than {velocity}, and its supply is used up after {reserve} more"
