"""A bearing that slides on a curved surface under a vertical load."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.friction import bristle
from rths_engine.parts.physics.search import PRESLIDING, TINY, Search, Seen, beyond
from rths_engine.parts.physics.wording import said


class PendulumFriction(Effect):
    """A bearing that slides on a curved surface under a vertical load.

    f = f_0 + k x + F (1 - r exp(-|v| / v_c)) z,  x_e z' = v - |v| z

    k = W / R (N/m) restores, W the vertical load, R the radius; F = mu W (N) is the friction at speed, (1 - r) F at low
    velocity, v_c (m/s) the velocity over which it grows. A fit does not change r. x_e (m) is the pre-sliding displacement.
    Neutral: k = F = 0. State: s[0] x of the last substep, s[1] z, s[2] 1 after the first substep.
    Source: Constantinou, Mokha and Reinhorn (1990), J. Struct. Eng. 116, 455-474. Not valid where the vertical load varies.
    """

    kind: Literal["pendulum_friction"] = "pendulum_friction"
    stiffness: float = quantity("Restoring stiffness k", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    friction: float = quantity("Friction at high velocity F", "N", "kN", ge=0, le=1e9, default=0.0)
    velocity: float = quantity("Velocity of the growth v_c", "m/s", "mm/s", gt=0, le=10, default=0.02)
    slow: float = quantity("Share of the friction missing at low velocity r", "1", "%", ge=0, le=0.95, default=0.5)
    presliding: float = quantity("Pre-sliding displacement x_e", "m", "mm", ge=1e-7, le=0.1, default=1e-4)
    title: ClassVar[str] = "Friction pendulum"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"stiffness": 0.0, "friction": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.stiffness, self.friction, self.velocity, self.slow, self.presliding]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[2] > 0.0:
            s[1] = bristle(s[1], (x - s[0]) / p[4])
        s[0] = x
        s[2] = 1.0
        return y + p[0] * x + p[1] * (1.0 - p[3] * math.exp(-abs(v) / p[2])) * s[1]


# chosen; see docs/decisions/0023
SLOWEST = 0.03  # of the largest velocity: friction that grows at lower velocities looks like Coulomb friction
RESTORES = 0.02  # least restoring force over the friction, at the largest displacement
FLATTEST = 5.0  # friction over the largest restoring force: bearings have 0.1 to 2, more is friction on a plane


class PendulumFrictionSearch(Search[PendulumFriction]):
    needs = ("x_meas", "f_meas")
    relatives = ("coulomb_friction", "parallel_stiffness", "stribeck_friction")
    held = ("slow",)
    otherwise: ClassVar = {"slow": 0.3}
    proportional = True
    noun = "friction under a vertical load"

    def guesses(self, seen: Seen) -> Iterator[PendulumFriction]:
        force, stiffness = 0.1 * seen.f, 0.1 * seen.stiffness
        yield self.sized(stiffness=stiffness, friction=force, velocity=0.15 * seen.v, presliding=0.01 * seen.x)

    def doubt(self, effect: PendulumFriction, seen: Seen) -> float:
        flat = beyond(effect.friction, FLATTEST * effect.stiffness * seen.x)
        return flat + beyond(effect.presliding, PRESLIDING * seen.x) + beyond(SLOWEST * seen.v, effect.velocity)

    def contradicted(self, effect: PendulumFriction, seen: Seen, measured: Array, step: float) -> str | None:
        restores = effect.stiffness * seen.x / max(effect.friction, TINY)
        return f"the restoring force is {100 * restores:.2g} % of the friction" if restores < RESTORES else None

    def says(self, effect: PendulumFriction) -> str:
        friction, stiffness = said(effect.friction, "kN"), said(effect.stiffness, "kN/m")
        return f"slides with a friction force that grows to {friction} at speed, and is restored with {stiffness}"
