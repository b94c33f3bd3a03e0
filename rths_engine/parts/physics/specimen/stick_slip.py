"""A force that holds the specimen at each reversal until it slips."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.friction import bristle
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said

# chosen; see docs/decisions/0023
RISE = 0.1  # of the release displacement, over which the force rises
HIGHEST = 2.0 * (RISE ** (RISE / (1.0 - RISE)) - RISE ** (1.0 / (1.0 - RISE)))  # largest z_1 - z_2 after a full reversal


class StickSlip(Effect):
    """A force that holds the specimen at each reversal until it slips.

    f = f_0 + F_s (z_1 - z_2) / 1.394,  x_s z_2' = v - |v| z_2,  0.1 x_s z_1' = v - |v| z_1

    After a reversal the force rises to F_s (N). It vanishes as the specimen moves on by x_s (m), the release displacement:
    static friction that a reversal renews. Neutral: F_s = 0.
    State: s[0] x of the last substep, s[1] z_1, s[2] z_2, s[3] 1 after the first substep.
    Source: breakaway of sliding bearings, Mokha, Constantinou and Reinhorn (1990), J. Struct. Eng. 116, 438-454;
    the two bristles are Dahl's (1968). Not valid where the force depends on the time at rest.
    """

    kind: Literal["stick_slip"] = "stick_slip"
    force: float = quantity("Sticking force F_s", "N", "kN", ge=0, le=1e9, default=0.0)
    release: float = quantity("Release displacement x_s", "m", "mm", ge=1e-6, le=1, default=1e-3)
    title: ClassVar[str] = "Stick-slip at reversals"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"force": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.force / HIGHEST, self.release]), np.zeros(4)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        if s[3] > 0.0:
            moved = (x - s[0]) / p[1]
            s[1] = bristle(s[1], moved / RISE)
            s[2] = bristle(s[2], moved)
        s[0] = x
        s[3] = 1.0
        return y + p[0] * (s[1] - s[2])


class StickSlipSearch(Search[StickSlip]):
    needs = ("x_meas", "f_meas")
    relatives = ("stribeck_friction", "coulomb_friction", "bouc_wen_hysteresis")
    proportional = True
    noun = "stick-slip"

    def guesses(self, seen: Seen) -> Iterator[StickSlip]:
        yield self.sized(force=0.1 * seen.f, release=0.1 * seen.x)

    def says(self, effect: StickSlip) -> str:
        return f"sticks at each reversal with {said(effect.force, 'kN')}, and slips within {said(effect.release, 'mm')}"
