"""Friction that decreases with velocity."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.friction import bristle
from rths_engine.parts.physics.search import PRESLIDING, Search, Seen, beyond
from rths_engine.parts.physics.wording import said


class StribeckFriction(Effect):
    """Friction that decreases with velocity.

    f = f_0 + (F_c + F_b exp(-(v / v_s)^2)) z,  x_e z' = v - |v| z

    F_c friction at speed, F_c + F_b breakaway friction (N), v_s Stribeck velocity (m/s), x_e pre-sliding displacement (m).
    Neutral: F_c = F_b = 0. State: s[0] x of the last substep, s[1] z, s[2] 1 after the first substep.
    Source: Armstrong-Helouvry, Dupont and Canudas de Wit (1994), Automatica 30, 1083-1138.
    Not valid where the friction lags the velocity (frictional memory).
    """

    kind: Literal["stribeck_friction"] = "stribeck_friction"
    friction: float = quantity("Coulomb friction at high velocity F_c", "N", "kN", ge=0, le=1e9, default=0.0)
    breakaway: float = quantity("Additional breakaway friction F_b", "N", "kN", ge=0, le=1e9, default=0.0)
    stribeck_velocity: float = quantity("Stribeck velocity v_s", "m/s", "mm/s", gt=0, le=10, default=0.01)
    presliding: float = quantity("Pre-sliding displacement x_e", "m", "mm", ge=1e-7, le=0.1, default=1e-4)
    title: ClassVar[str] = "Stribeck friction"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"friction": 0.0, "breakaway": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.friction, self.breakaway, self.stribeck_velocity, self.presliding]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] > 0.0:
            s[1] = bristle(s[1], (x - s[0]) / p[3])
        s[0] = x
        s[2] = 1.0
        ratio = v / p[2]
        return y + (p[0] + p[1] * math.exp(-ratio * ratio)) * s[1]


class StribeckFrictionSearch(Search[StribeckFriction]):
    needs = ("x_meas", "f_meas")
    relatives = ("coulomb_friction", "bouc_wen_hysteresis", "stick_slip", "pendulum_friction")
    proportional = True
    noun = "Stribeck friction"

    def guesses(self, seen: Seen) -> Iterator[StribeckFriction]:
        for share in (0.03, 0.15):
            friction = 0.1 * seen.f
            yield self.sized(friction=friction, breakaway=friction, stribeck_velocity=share * seen.v, presliding=0.01 * seen.x)

    def doubt(self, effect: StribeckFriction, seen: Seen) -> float:
        return beyond(effect.presliding, PRESLIDING * seen.x)

    def says(self, effect: StribeckFriction) -> str:
        most, least = said(effect.friction + effect.breakaway, "kN"), said(effect.friction, "kN")
        velocity = said(effect.stribeck_velocity, "mm/s")
        return f"resists motion with a friction force of {most} at low velocity and {least} well above {velocity}"
