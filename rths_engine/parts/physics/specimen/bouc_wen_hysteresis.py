"""A Bouc-Wen element beside the specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, TypeVar

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import PRESLIDING, Search, Seen, beyond
from rths_engine.parts.physics.wording import said
from rths_engine.parts.specimens.bouc_wen import moved


class BoucWenHysteresis(Effect):
    """A Bouc-Wen element beside the specimen.

    f = f_0 + F zeta,  x_y zeta' = v (1 - |zeta|^n (eta sgn(v zeta) + 1 - eta))

    F (N) strength, x_y (m) yield displacement, n sharpness, eta fullness of the unloading, integrated as in
    `specimens.bouc_wen`. Neutral: F = 0. State: s[0] x of the last substep, s[1] zeta, s[2] 1 after the first substep.
    Source: Wen (1976), J. Eng. Mech. Div. ASCE 102, 249-263. Not valid in small cycles after partial unloading.
    """

    kind: Literal["bouc_wen_hysteresis"] = "bouc_wen_hysteresis"
    strength: float = quantity("Strength F", "N", "kN", ge=0, le=1e9, default=0.0)
    yield_displacement: float = quantity("Yield displacement x_y", "m", "mm", gt=0, le=1, default=2e-3)
    exponent: float = quantity("Exponent n", ge=1, le=20, default=1.0)
    fullness: float = quantity("Fullness η", ge=0.5, le=1, default=0.5)
    title: ClassVar[str] = "Bouc-Wen hysteresis"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"strength": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.strength, self.yield_displacement, self.exponent, self.fullness]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] > 0.0:
            s[1] = moved(s[1], (x - s[0]) / p[1], p[2], p[3])
        s[0] = x
        s[2] = 1.0
        return y + p[0] * s[1]


E = TypeVar("E", bound=BoucWenHysteresis)


class BoucWenHysteresisSearch(Search[E]):
    needs: tuple[str, ...] = ("x_meas", "f_meas")
    relatives: tuple[str, ...] = ("coulomb_friction", "stribeck_friction", "self_centring", "stick_slip")
    held = ("fullness",)
    otherwise: ClassVar = {"fullness": 0.75}
    proportional = True
    noun = "hysteresis"

    def guesses(self, seen: Seen) -> Iterator[E]:
        for share, exponent in ((0.05, 1.0), (0.3, 1.0), (0.3, 4.0)):
            yield self.sized(strength=0.1 * seen.f, yield_displacement=share * seen.x, exponent=exponent)

    def doubt(self, effect: E, seen: Seen) -> float:
        return beyond(PRESLIDING * seen.x, effect.yield_displacement)

    def says(self, effect: E) -> str:
        strength, yielded = said(effect.strength, "kN"), said(effect.yield_displacement, "mm")
        return f"has a further hysteretic force of {strength} that yields at {yielded}"
