"""Another exponent of the velocity."""

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
SLOW = 0.05  # of the reference velocity: slower motion counts as this fast
FAST = 1e6


class VelocityExponent(Effect):
    """Another exponent of the velocity.

    f = f_0 ((r^2 + s^2) / (1 + s^2))^(e/2),  r = v / v_r, s = 0.05

    A force that grew with |v|^n grows with |v|^(n + e). The force at the reference velocity v_r (m/s) stays; below s v_r the
    factor levels out, so that it is bounded for e < 0. v_r only moves the strength of the specimen's own model, and is held.
    Neutral: e = 0. No state.
    Source: the fractional power law of fluid viscous dampers, Lee and Taylor (2001), Struct. Des. Tall Build. 10, 311-320.
    Fails first where the force also has a part that is not of the velocity: spring or friction scale as well.
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
    noun = "another velocity exponent"

    def guesses(self, seen: Seen) -> Iterator[VelocityExponent]:
        yield self.sized(exponent=0.2, reference_velocity=0.5 * seen.v)

    def says(self, effect: VelocityExponent) -> str:
        way = "faster" if effect.exponent >= 0 else "slower"
        power, velocity = said(abs(effect.exponent), "1"), said(effect.reference_velocity, "mm/s")
        return f"grows {way} with velocity than its model, by the power {power} (equal at {velocity})"
