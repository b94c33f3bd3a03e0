"""Strength that changes with the temperature."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import HEAT, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said

# chosen; see docs/decisions/0023
FURTHEST = 30.0  # largest exponent: e^30 is beyond any specimen


class StrengthAgainstTemperature(Effect):
    """Strength that changes with the temperature.

    f = f_0 exp(-beta (T - T_0))

    T (K) is the recorded temperature of the specimen, or that of the plan. The viscosity of a fluid, and with it the force,
    falls with the coefficient beta (1/K); a negative beta is a force that rises. The reference temperature T_0, at which the
    force is as planned, is held. Neutral: beta = 0. No state.
    Source: Reynolds (1886), "On the theory of lubrication", Phil. Trans. R. Soc. 177, 157-234, viscosity over temperature.
    Not valid where the sensor sits away from the fluid, whose temperature it then follows late.
    """

    kind: Literal["strength_against_temperature"] = "strength_against_temperature"
    coefficient: float = quantity("Temperature coefficient β", "1/K", ge=-1, le=1, default=0.0)
    reference: float = quantity("Reference temperature T₀", "K", gt=0, le=2000, default=293.15, help="293.15 K is 20 °C")
    title: ClassVar[str] = "Strength against temperature"
    hook: ClassVar[int] = HEAT
    neutral: ClassVar = {"coefficient": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.coefficient, self.reference]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y * math.exp(min(max(p[0] * (p[1] - w), -FURTHEST), FURTHEST))


class StrengthAgainstTemperatureSearch(Search[StrengthAgainstTemperature]):
    needs = ("x_meas", "f_meas", "temperature")
    relatives = ("viscous_heating", "strength_drop")
    held = ("reference",)
    noun = "strength that depends on the temperature"

    def guesses(self, seen: Seen) -> Iterator[StrengthAgainstTemperature]:
        for coefficient in (0.01, -0.01):
            yield self.sized(coefficient=coefficient, reference=seen.temperature)

    def says(self, effect: StrengthAgainstTemperature) -> str:
        change = said(abs(-math.expm1(-effect.coefficient)), "%")
        verb = "loses" if effect.coefficient >= 0 else "gains"
        return f"{verb} {change} of its force for each kelvin above {said(effect.reference, 'degC')}"
