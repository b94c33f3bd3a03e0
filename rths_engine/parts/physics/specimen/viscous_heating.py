"""Force that decreases as the specimen heats up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import lost

# chosen; see docs/decisions/0023
LEAST = 0.05  # of the cold force


class ViscousHeating(Effect):
    """Force that decreases as the specimen heats up.

    f = f_0 max(1 - phi E, 0.05),  E' = f v

    E (J) is the work done on the specimen so far; all of it heats the specimen except the energy that its springs return.
    phi (1/J) is the share of the force that is lost for each joule. E follows the trapezoidal rule. Neutral: phi = 0.
    State: s[0] E, s[1] x and s[2] f of the last substep, s[3] 1 after the first substep.
    Source: Makris, Roussos, Whittaker and Kelly (1998), J. Eng. Mech. 124, 1217-1223: no heat leaves in a short test.
    Not valid where heat leaves during the test, or where the force falls below half: the viscosity then levels off.
    """

    kind: Literal["viscous_heating"] = "viscous_heating"
    fade: float = quantity("Force loss per dissipated energy φ", "1/J", "1/MJ", ge=0, le=1, default=0.0)
    title: ClassVar[str] = "Viscous heating"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"fade": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.fade]), np.zeros(4)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        force = y * min(max(1.0 - p[0] * s[0], LEAST), 1.0)
        if s[3] > 0.0:
            s[0] += 0.5 * (force + s[2]) * (x - s[1])
        s[1] = x
        s[2] = force
        s[3] = 1.0
        return force


class ViscousHeatingSearch(Search[ViscousHeating]):
    needs = ("x_meas", "f_meas")
    relatives = ("strength_degradation", "strength_drop", "strength_against_temperature")
    noun = "viscous heating"

    def guesses(self, seen: Seen) -> Iterator[ViscousHeating]:
        for loss in (0.1, 0.4):
            yield self.sized(fade=loss / max(seen.energy, 1.0))

    def says(self, effect: ViscousHeating) -> str:
        share, unit = lost(effect.fade, "MJ")
        return f"loses {share} of its force for every {unit} that it dissipates"
