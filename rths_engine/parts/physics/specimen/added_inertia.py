"""Mass that moves with the piston before the load cell."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class AddedInertia(Effect):
    """Mass that moves with the piston before the load cell.

    f = f_0 + m (x[q] - 2 x[q-1] + x[q-2]) / dt^2

    m (kg) is the mass of clevis, rod or fixture between load cell and specimen. The second difference is the acceleration half
    a substep before v. Neutral: m = 0.
    State: s[0] x[q-1], s[1] x[q-2], s[2] samples so far, up to 2; no force before the third sample.
    Not valid for displacements with measurement noise, which the second difference multiplies by 4 m / dt^2: smooth them first.
    """

    kind: Literal["added_inertia"] = "added_inertia"
    mass: float = quantity("Mass m", "kg", "t", ge=0, le=1e7, default=0.0)
    title: ClassVar[str] = "Added inertia"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"mass": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.mass]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        acceleration = 0.0
        if s[2] > 1.5:
            acceleration = (x - 2.0 * s[0] + s[1]) / (dt * dt)
        s[1] = s[0]
        s[0] = x
        s[2] = min(s[2] + 1.0, 2.0)
        return y + p[0] * acceleration


class AddedInertiaSearch(Search[AddedInertia]):
    needs = ("x_meas", "f_meas")
    relatives = ("parallel_stiffness",)
    proportional = True
    noun = "added inertia"

    def guesses(self, seen: Seen) -> Iterator[AddedInertia]:
        yield self.sized(mass=0.1 * seen.f / max(seen.acceleration, 1e-6))

    def says(self, effect: AddedInertia) -> str:
        return f"has a measured force that includes the inertia of {said(effect.mass, 'kg')}"
