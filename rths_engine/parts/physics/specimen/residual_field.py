"""Residual field that keeps strength after the current has fallen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class ResidualField(Effect):
    """Residual field that keeps strength after the current has fallen: hysteresis of strength against current.

    f = f_0 (i_0 + h) / (i_0 + |i|),  h = min(max(h_last, |i| - i_r), |i| + i_r)

    The steel of the magnetic circuit keeps a field after the current i (A) has fallen. h (A) is the play operator of |i|: the
    field lags the current by the residual current i_r (A), which is what remains of it without current. The force of the model
    is assumed proportional to i_0 + |i|, where i_0 stands for the force without current. Neutral: i_r = 0.
    State: s[0] h, s[1] 1 after the first substep. At the start h = |i|.
    Sources: Brokate and Sprekels (1996), "Hysteresis and Phase Transitions", section 2.1, the play operator; An and Kwon
    (2003), J. Intell. Mater. Syst. Struct. 14, 541-550, hysteresis of the magnetic circuit of an MR device.
    Not valid where the current changes its sign to demagnetise the steel, where the magnetic circuit saturates, or within the
    coil lag of the plan's damper after a jump, because h follows the commanded current.
    """

    kind: Literal["residual_field"] = "residual_field"
    residual: float = quantity("Residual current i_r", "A", ge=0, le=1000, default=0.0)
    off_current: float = quantity("Equivalent current of the zero-current force i₀", "A", gt=0, le=1000, default=0.5)
    title: ClassVar[str] = "Residual field"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"residual": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.residual, self.off_current]), np.zeros(2)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        current = abs(w)
        if s[1] == 0.0:
            s[0] = current
            s[1] = 1.0
        s[0] = min(max(s[0], current - p[0]), current + p[0])
        return y * (p[1] + s[0]) / (p[1] + current)


class ResidualFieldSearch(Search[ResidualField]):
    needs = ("x_meas", "f_meas", "current")
    relatives = ("current_lag", "strength_against_current")
    noun = "the residual field"

    def guesses(self, seen: Seen) -> Iterator[ResidualField]:
        for residual in (0.03, 0.15):
            yield self.sized(residual=residual * seen.current, off_current=0.3 * seen.current)

    def says(self, effect: ResidualField) -> str:
        return f"keeps the strength of {said(effect.residual, 'A')} after its current has fallen"
