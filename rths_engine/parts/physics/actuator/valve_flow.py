"""A valve whose flow falls with the force on the piston."""

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

# chosen; see docs/decisions/0023
FASTEST = 2.0  # times the pressure difference without load: an overrunning load of the stall force


class ValveFlow(Effect):
    """A valve whose flow falls with the force on the piston.

    y = x + e sqrt(max(1 - r F sgn(e), 0)),  e = d - x

    The flow of an orifice grows with the square root of its pressure difference, which a force F against the motion reduces.
    The drive feels only this part of the error e between the command d and the piston x, so that it moves slower against a
    force, and faster with a force that helps. r (1/N) is the inverse of the stall force A p_s. Neutral: r = 0. No state.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley, chapter 5. Not valid where the piston is not symmetric.
    """

    kind: Literal["valve_flow"] = "valve_flow"
    inverse_stall_force: float = quantity("Inverse of the stall force r", "1/N", "1/kN", ge=0, le=1, default=0.0)
    title: ClassVar[str] = "Valve orifice flow"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"inverse_stall_force": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.inverse_stall_force]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        error = y - x
        load = p[0] * w if error > 0.0 else -p[0] * w
        return x + error * math.sqrt(min(max(1.0 - load, 0.0), FASTEST))


class ValveFlowSearch(Search[ValveFlow]):
    needs = ("x_comp", "x_meas", "f_meas")
    relatives = ("force_compliance", "velocity_saturation", "supply_saturation")
    noun = "the flow of the valve's orifice"

    def guesses(self, seen: Seen) -> Iterator[ValveFlow]:
        yield self.sized(inverse_stall_force=0.3 / max(seen.f, TINY))

    def says(self, effect: ValveFlow) -> str:
        return f"moves slower against a force and would stall at {said(1 / max(effect.inverse_stall_force, TINY), 'kN')}"
