"""A different exponent of the velocity."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said

# chosen; see docs/decisions/0023
SLOW = 0.05  # of the reference velocity: below it the factor levels off
FAST = 1e6


class VelocityExponent(Effect):
    """A different exponent of the velocity.

    f = f_0 ((r^2 + s^2) / (1 + s^2))^(e/2),  r = v / v_r, s = 0.05

    A force proportional to |v|^n becomes proportional to |v|^(n + e). The force at the reference velocity v_r (m/s) does not
    change. Below s v_r the factor levels off, so that it is bounded for e < 0. A fit does not change v_r, because v_r only
    scales the strength of the specimen's model. Neutral: e = 0. No state.
    Source: the fractional power law of fluid viscous dampers, Lee and Taylor (2001), Struct. Des. Tall Build. 10, 311-320.
    Not valid where the force also has a part that does not depend on velocity: the factor scales spring and friction too.
    """

    kind: Literal["velocity_exponent"] = "velocity_exponent"
    exponent: float = quantity("Additional exponent e", ge=-0.95, le=2, default=0.0)
    reference_velocity: float = quantity("Reference velocity v_r", "m/s", "mm/s", gt=0, le=10, default=0.1)
    title: ClassVar[str] = "Velocity exponent"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"exponent": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([0.5 * self.exponent, self.reference_velocity]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        ratio = min(abs(v / p[1]), FAST)
        return y * ((ratio * ratio + SLOW * SLOW) / (1.0 + SLOW * SLOW)) ** p[0]


class VelocityExponentSearch(Search[VelocityExponent]):
    needs = ("x_meas", "f_meas")
    relatives = ("stribeck_friction", "coulomb_friction")
    held = ("reference_velocity",)
    noun = "a different velocity exponent"

    def guesses(self, seen: Seen) -> Iterator[VelocityExponent]:
        yield self.sized(exponent=0.2, reference_velocity=0.5 * seen.v)

    def says(self, effect: VelocityExponent) -> str:
        way = "faster" if effect.exponent >= 0 else "slower"
        power, velocity = said(abs(effect.exponent), "1"), said(effect.reference_velocity, "mm/s")
        return f"has a force that grows {way} with velocity than in its model, by the exponent {power} (equal at {velocity})"
