"""Coulomb friction beside the specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, TypeVar

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.friction import bristle
from rths_engine.parts.physics.search import PRESLIDING, Search, Seen, beyond
from rths_engine.parts.physics.wording import said


class CoulombFriction(Effect):
    """Coulomb friction beside the specimen.

    f = f_0 + F_c z,  x_e z' = v - |v| z

    F_c is the friction force (N) in both directions, x_e the pre-sliding displacement (m) over which the friction builds up
    after a reversal. Neutral: F_c = 0. z is exact for steps in x.
    State: s[0] x of the last substep, s[1] z, s[2] 1 after the first substep.
    Source: Dahl (1968), A Solid Friction Model, TOR-0158(3107-18)-1, with the exponent 1: Coulomb's law, elastic contact.
    Not valid where static friction exceeds kinetic friction.
    """

    kind: Literal["coulomb_friction"] = "coulomb_friction"
    friction: float = quantity("Friction force F_c", "N", "kN", ge=0, le=1e9, default=0.0)
    presliding: float = quantity("Pre-sliding displacement x_e", "m", "mm", ge=1e-7, le=0.1, default=1e-4)
    title: ClassVar[str] = "Coulomb friction"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"friction": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.friction, self.presliding]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] > 0.0:
            s[1] = bristle(s[1], (x - s[0]) / p[1])
        s[0] = x
        s[2] = 1.0
        return y + p[0] * s[1]


E = TypeVar("E", bound=CoulombFriction)


class CoulombFrictionSearch(Search[E]):
    needs: tuple[str, ...] = ("x_meas", "f_meas")
    relatives: tuple[str, ...] = (
        "stribeck_friction",
        "bouc_wen_hysteresis",
        "velocity_exponent",
        "pendulum_friction",
        "stick_slip",
    )
    proportional = True
    noun = "Coulomb friction"

    def guesses(self, seen: Seen) -> Iterator[E]:
        yield self.sized(friction=0.1 * seen.f, presliding=0.01 * seen.x)

    def doubt(self, effect: E, seen: Seen) -> float:
        return beyond(effect.presliding, PRESLIDING * seen.x)

    def says(self, effect: E) -> str:
        return f"resists every motion with a friction force of {said(effect.friction, 'kN')}"
