"""Strength that follows the current by another law than the plan's."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class StrengthAgainstCurrent(Effect):
    """Strength that follows the current by another law than the plan's.

    f = f_0 max(1 - kappa (1 - g(i) / g(i_r)), 0),  g(i) = tanh(|i| / i_s)

    i (A) is the current. kappa is the share of the planned force that is lost as the current falls from i_r to zero; where the
    plan ignores the current, it is the share of the whole force. The fluid saturates near i_s. The reference current i_r, at
    which the force is as planned, is held. Neutral: kappa = 0. No state.
    Source: Carlson (2005), Int. J. Mod. Phys. B 19, 1463-1470, yield stress of the fluid over the field strength.
    A current of two levels, as of on-off control, leaves i_s open: its interval says how well the recording shows it.
    Not valid where friction of the seals, which ignores the current, has another shape than the force of the fluid.
    """

    kind: Literal["strength_against_current"] = "strength_against_current"
    share: float = quantity("Share of the planned force lost without current κ", ge=-20, le=20, default=0.0)
    saturation_current: float = quantity("Saturation current i_s", "A", gt=0, le=1000, default=1.0)
    reference_current: float = quantity("Reference current i_r", "A", gt=0, le=1000, default=2.5)
    title: ClassVar[str] = "Strength against current"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        full = max(math.tanh(self.reference_current / self.saturation_current), TINY)
        return np.array([self.share, self.saturation_current, full]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y * max(1.0 - p[0] * (1.0 - math.tanh(abs(w) / p[1]) / p[2]), 0.0)


class StrengthAgainstCurrentSearch(Search[StrengthAgainstCurrent]):
    needs = ("x_meas", "f_meas", "current")
    relatives = ("current_lag", "residual_field")
    held = ("reference_current",)
    noun = "strength that follows the current"

    def guesses(self, seen: Seen) -> Iterator[StrengthAgainstCurrent]:
        for saturation in (0.3, 1.0):
            for share in (0.3, -0.3):
                yield self.sized(share=share, saturation_current=saturation * seen.current, reference_current=seen.current)

    def says(self, effect: StrengthAgainstCurrent) -> str:
        left, full = said(max(1.0 - effect.share, 0.0), "%"), said(effect.reference_current, "A")
        return f"has {left} of the planned force without current and 100 % at {full}"
