"""Force that lags the current."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class CurrentLag(Effect):
    """Force that lags the current.

    f = f_0 (i_0 + i_f) / (i_0 + |i|),  tau i_f' = |i| - i_f

    The field of the coil, and with it the force, follows the current i (A) with the time constant tau (s). The force of the
    model is assumed proportional to i_0 + |i|, where i_0 stands for the force without current. The step is exact for a current
    that is constant over the substep. Neutral: tau = 0.
    State: s[0] i_f, s[1] 1 after the first substep. At the start i_f = |i|.
    Source: Jiang and Christenson (2012), Smart Mater. Struct. 21, 065002, first-order inductance of a large MR damper.
    Not valid where the magnetic circuit saturates, or where eddy currents make the lag depend on the size of the change.
    """

    kind: Literal["current_lag"] = "current_lag"
    lag: float = quantity("Lag τ", "s", "ms", ge=0, le=10, default=0.0)
    off_current: float = quantity("Equivalent current of the zero-current force i₀", "A", gt=0, le=100, default=0.5)
    title: ClassVar[str] = "Current lag"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"lag": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        decay = math.exp(-dt / self.lag) if self.lag > 0 else 0.0
        return np.array([decay, self.off_current]), np.zeros(2)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        current = abs(w)
        if s[1] == 0.0:
            s[0] = current
            s[1] = 1.0
        s[0] = current + p[0] * (s[0] - current)
        return y * (p[1] + s[0]) / (p[1] + current)


class CurrentLagSearch(Search[CurrentLag]):
    needs = ("x_meas", "f_meas", "current")
    relatives = ("strength_drop", "residual_field", "strength_against_current")
    noun = "current lag"

    def guesses(self, seen: Seen) -> Iterator[CurrentLag]:
        for lag in (0.02, 0.2):
            yield self.effect(lag=lag)

    def says(self, effect: CurrentLag) -> str:
        return f"follows its current with a time constant of {said(effect.lag, 'ms')}"
