"""Viscosity that differs between the two directions of motion."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class AsymmetricViscosity(Effect):
    """Viscosity that differs between the two directions of motion.

    f = f_0 + c_a |v|

    c_a (N s/m) is half the difference of the damping coefficients in positive and in negative velocity. It has either sign.
    Causes are orifices or valves that open in one direction. Neutral: c_a = 0. No state.
    Source: dampers with check valves, Dixon (2007), "The Shock Absorber Handbook", Wiley. Not valid where a preload opens it.
    """

    kind: Literal["asymmetric_viscosity"] = "asymmetric_viscosity"
    damping: float = quantity("Asymmetric damping c_a", "N*s/m", "kN*s/m", ge=-1e12, le=1e12, default=0.0)
    title: ClassVar[str] = "Asymmetric viscosity"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"damping": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.damping]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * abs(v)


class AsymmetricViscositySearch(Search[AsymmetricViscosity]):
    needs = ("x_meas", "f_meas")
    relatives = ("asymmetry",)
    proportional = True
    noun = "asymmetric viscosity"

    def guesses(self, seen: Seen) -> Iterator[AsymmetricViscosity]:
        yield self.sized(damping=0.1 * seen.f / max(seen.v, TINY))

    def says(self, effect: AsymmetricViscosity) -> str:
        way, other = ("positive", "negative") if effect.damping > 0 else ("negative", "positive")
        damping = said(abs(effect.damping), "kN*s/m")
        return f"has a viscosity that is {damping} larger in {way} velocity, and as much smaller in {other} velocity"
