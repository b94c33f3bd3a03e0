"""A self-centring element beside the specimen, with a flag-shaped hysteresis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, TypeVar

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class SelfCentring(Effect):
    """A self-centring element beside the specimen, with a flag-shaped hysteresis.

    f = f_0 + F zeta,  x_a zeta' = v,  min(r, 1 - beta) <= zeta <= min(r, 1),  r = x / x_a >= 0; for x < 0 mirrored

    The element opens at the force F (N) and the displacement x_a (m), and closes at (1 - beta) F: beta = 0 dissipates nothing,
    beta = 1 closes at zero force. Neutral: F = 0. State: s[0] x of the last substep, s[1] zeta, s[2] 1 after the first substep.
    Source: Christopoulos, Filiatrault and Folz (2002), EESD 31, 1131-1150.
    Not valid where the opened element hardens: add a parallel stiffness for that.
    """

    kind: Literal["self_centring"] = "self_centring"
    strength: float = quantity("Opening force F", "N", "kN", ge=0, le=1e9, default=0.0)
    opening: float = quantity("Opening displacement x_a", "m", "mm", gt=0, le=1, default=2e-3)
    width: float = quantity("Flag width β", "1", "%", ge=0, le=1, default=0.8)
    title: ClassVar[str] = "Self-centring"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"strength": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.strength, self.opening, self.width]), np.zeros(3)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        moved = (x - s[0]) / p[1] if s[2] > 0.0 else 0.0
        s[0] = x
        s[2] = 1.0
        way = 1.0 if x >= 0.0 else -1.0
        reach = abs(x) / p[1]
        zeta = way * (s[1] + moved)
        s[1] = way * min(max(zeta, min(reach, 1.0 - p[2])), min(reach, 1.0))
        return y + p[0] * s[1]


E = TypeVar("E", bound=SelfCentring)


class SelfCentringSearch(Search[E]):
    needs: tuple[str, ...] = ("x_meas", "f_meas")
    relatives: tuple[str, ...] = ("bouc_wen_hysteresis", "pinching", "cubic_stiffness")
    proportional = True
    noun = "self-centring"

    def guesses(self, seen: Seen) -> Iterator[E]:
        yield self.sized(strength=0.1 * seen.f, opening=0.12 * seen.x, width=0.6)

    def says(self, effect: E) -> str:
        back = said(effect.strength * (1 - effect.width), "kN")
        return f"has a further force that opens at {said(effect.strength, 'kN')} and returns to its centre at {back}"
