"""A piston that deflects under the force on it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import PISTON, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class ForceCompliance(Effect):
    """A piston that deflects under the force on it.

    y = y_0 - c,  tau c' = phi F - c

    The oil column and the rod deflect by phi (m/N) times the specimen's force F of the last substep, with the lag tau (s). The
    lag also keeps the explicit step stable while about phi k < 2 tau / dt, for a specimen of stiffness k. Neutral: phi = 0.
    State: s[0] c. Source: Merritt (1967), "Hydraulic Control Systems", Wiley.
    Not valid where the integral part of the controller slowly removes the deflection.
    """

    kind: Literal["force_compliance"] = "force_compliance"
    flexibility: float = quantity("Flexibility φ", "m/N", "mm/kN", ge=0, le=1, default=0.0)
    lag: float = quantity("Lag τ", "s", "ms", gt=0, le=1, default=0.005)
    title: ClassVar[str] = "Force compliance"
    hook: ClassVar[int] = PISTON
    neutral: ClassVar = {"flexibility": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.flexibility, -math.expm1(-dt / self.lag)]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        s[0] += p[1] * (p[0] * w - s[0])
        return y - s[0]


class ForceComplianceSearch(Search[ForceCompliance]):
    needs = ("x_comp", "x_meas", "f_meas")
    relatives = ("gain_error", "stick_friction", "valve_flow")
    held = ("lag",)
    noun = "compliance under force"

    def guesses(self, seen: Seen) -> Iterator[ForceCompliance]:
        for share in (0.01, 0.05):
            yield self.sized(flexibility=share / max(seen.stiffness, TINY))

    def says(self, effect: ForceCompliance) -> str:
        return f"deflects by {said(effect.flexibility, 'mm/kN')} of force on its piston"
