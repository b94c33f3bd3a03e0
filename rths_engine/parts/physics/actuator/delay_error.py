"""A delay longer or shorter than that of the actuator model."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.delay import HEAD, delayed, ring
from rths_engine.parts.physics.effect import COMMAND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class DelayError(Effect):
    """A delay longer or shorter than that of the actuator model.

    y(t) = d(t - T)

    The command d reaches the actuator T (s) later than in its model, or earlier for T < 0. An earlier command is extrapolated
    along its last slope, y = d + |T| v, which is valid while omega |T| is small. Linear between substeps. Neutral: T = 0.
    State: the ring of `physics.delay`.
    Source: Horiuchi et al. (1999), EESD 28, 1121-1141: a delay T acts as the negative damping -k T of a specimen k.
    Not valid where the delay changes with amplitude or frequency.
    """

    kind: Literal["delay_error"] = "delay_error"
    delay: float = quantity("Additional delay T", "s", "ms", ge=-0.1, le=0.2, default=0.0)
    title: ClassVar[str] = "Delay error"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"delay": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        state = ring(self.delay, dt)
        return np.array([self.delay / dt, len(state) - HEAD]), state

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return delayed(s, int(p[1]), y, p[0])


class DelayErrorSearch(Search[DelayError]):
    needs = ("x_comp", "x_meas")
    relatives = ("second_order_lag", "amplitude_dependent_delay", "backlash")
    noun = "a delay error"

    def guesses(self, seen: Seen) -> Iterator[DelayError]:
        yield self.effect(delay=0.005)

    def says(self, effect: DelayError) -> str:
        way = "later" if effect.delay >= 0 else "earlier"
        return f"follows its command {said(abs(effect.delay), 'ms')} {way} than its model"
