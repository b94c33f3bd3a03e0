"""A spring that hardens or softens with its stroke."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, TypeVar

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class CubicStiffness(Effect):
    """A spring that hardens or softens with its stroke.

    f = f_0 + k_3 x^3

    k_3 (N/m^3) is positive for a spring that hardens. Neutral: k_3 = 0. No state. For a sine of amplitude X the spring adds the
    stiffness 3/4 k_3 X^2 to the first harmonic, and a third harmonic of the force k_3 X^3 / 4.
    Source: Duffing's spring; Nayfeh and Mook (1979), "Nonlinear Oscillations", Wiley. Not valid at a stop.
    """

    kind: Literal["cubic_stiffness"] = "cubic_stiffness"
    stiffness: float = quantity("Cubic stiffness k₃", "N/m^3", "kN/m^3", ge=-1e18, le=1e18, default=0.0)
    title: ClassVar[str] = "Cubic stiffness"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"stiffness": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * x * x * x


E = TypeVar("E", bound=CubicStiffness)


class CubicStiffnessSearch(Search[E]):
    needs: tuple[str, ...] = ("x_meas", "f_meas")
    relatives: tuple[str, ...] = ("parallel_stiffness", "pinching", "gap_contact")
    proportional = True
    noun = "cubic stiffness"

    def guesses(self, seen: Seen) -> Iterator[E]:
        yield self.sized(stiffness=0.1 * seen.stiffness / max(seen.x * seen.x, TINY))

    def says(self, effect: E) -> str:
        way = "hardens" if effect.stiffness >= 0 else "softens"
        return f"{way} with its stroke by {said(abs(effect.stiffness), 'kN/m^3')}"
