"""Delay that grows with the amplitude."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.delay import HEAD, delayed, ring
from rths_engine.parts.physics.effect import COMMAND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said

# chosen; see docs/decisions/0023
LONGEST = 0.1  # s


class AmplitudeDependentDelay(Effect):
    """Delay that grows with the amplitude.

    y(t) = d(t - min(b a, 0.1 s)),  a = the largest recent |d|, which decays as exp(-t / T_a)

    The delay grows by b (s/m) with the amplitude a of the command; T_a (s) is the memory of the amplitude. Neutral: b = 0.
    State: a, then the ring of `physics.delay`.
    Source: Darby, Williams and Blakeborough (2002), J. Eng. Mech. 128, 1306-1314, about delays that change during a test.
    Not valid where the delay follows the velocity or the force more than the amplitude.
    """

    kind: Literal["amplitude_dependent_delay"] = "amplitude_dependent_delay"
    slope: float = quantity("Delay per amplitude b", "s/m", "ms/mm", ge=0, le=100, default=0.0)
    memory: float = quantity("Memory time of the amplitude T_a", "s", gt=0, le=100, default=2.0)
    title: ClassVar[str] = "Amplitude-dependent delay"
    hook: ClassVar[int] = COMMAND
    neutral: ClassVar = {"slope": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        state = ring(LONGEST if self.slope > 0 else 0.0, dt)
        values = [self.slope / dt, LONGEST / dt, math.exp(-dt / self.memory), len(state) - HEAD]
        return np.array(values), np.append(0.0, state)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        s[0] = max(abs(y), p[2] * s[0])
        return delayed(s[1:], int(p[3]), y, min(p[0] * s[0], p[1]))


class AmplitudeDependentDelaySearch(Search[AmplitudeDependentDelay]):
    needs = ("x_comp", "x_meas")
    relatives = ("delay_error", "velocity_saturation")
    held = ("memory",)
    otherwise: ClassVar = {"memory": 1.0}
    noun = "an amplitude-dependent delay"

    def guesses(self, seen: Seen) -> Iterator[AmplitudeDependentDelay]:
        yield self.sized(slope=0.01 / max(seen.x, 1e-6))

    def says(self, effect: AmplitudeDependentDelay) -> str:
        return f"follows its command with a delay that grows by {said(effect.slope, 'ms/mm')} of amplitude"
