"""Magneto-rheological damper whose strength and viscosity follow a current."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.parts.specimens.mr_damper import MrDamper, slid


class MrDamperCurrent(Commanded):
    """Magneto-rheological damper whose strength and viscosity follow a current: `mr_damper` with a and b as functions of it.

    a = a_s (r_a + (1 - r_a) g),  b = b_s (r_b + (1 - r_b) g),  g = tanh(i_c / i_s),  tau i_c' = |i| - i_c

    i (A) is the commanded current and i_c (A) the current in the coil, which follows with the time constant tau = L / R of
    coil and amplifier. a_s and b_s are the values at magnetic saturation, r_a and r_b their shares that remain without current.
    i_s sets how soon the fluid saturates: g = 0.76 at i_s and 0.96 at 2 i_s. The lag is exact for a current that is constant
    over a substep; at the start i_c = |i|. x (m), f (N).
    State: s[0] last displacement (m), s[1] force (N), s[2] i_c (A), s[3] 1 after the first substep, s[4] a (N), s[5] b.
    Not valid for the residual field of the steel after a large current, when the fluid heats up, or for eddy currents, which
    make the lag depend on the size of the change.
    Sources: the law of saturation after Carlson (2005), Int. J. Mod. Phys. B 19, 1463-1470, yield stress over field strength.
    i_s and r_a after Yang, Spencer, Jung and Carlson (2004), J. Eng. Mech. 130, 1107-1114, force over current of a 200 kN
    damper; a and b at 2.5 A after Chae, Ricles and Sause (2013), EESD 42, 669-685; r_b and tau are chosen.
    """

    kind: Literal["mr_damper_current"] = "mr_damper_current"
    yield_force: float = quantity("Slider yield force at saturation a_s", "N", "kN", ge=0, le=1e8, default=140.2e3)
    yield_share: float = quantity("Share of the yield force without current r_a", ge=0, le=1, default=0.11)
    rate_coefficient: float = quantity(
        "Slider rate coefficient at saturation b_s", "N*(s/m)^n", "kN*(s/m)^n", ge=0, le=1e9, default=163.2e3
    )
    rate_share: float = quantity("Share of the rate coefficient without current r_b", ge=0, le=1, default=0.37)
    rate_exponent: float = quantity("Slider rate exponent n", gt=0.05, le=1, default=0.46)
    saturation_current: float = quantity("Saturation current i_s", "A", gt=0, le=1000, default=1.0)
    coil_lag: float = quantity(
        "Time constant of the coil τ", "s", "ms", ge=0, le=10, default=0.02, help="0 where the current is measured in the coil"
    )
    stiffness: float = quantity("Maxwell spring stiffness", "N/m", "kN/m", gt=0, le=1e12, default=1.0e8)
    damping: float = quantity("Maxwell dashpot coefficient", "N*s/m", "kN*s/m", gt=0, le=1e12, default=1.0e7)
    title: ClassVar[str] = "MR damper with current"

    def build(self, dt: float) -> tuple[Array, Array]:
        kept = math.exp(-dt / self.coil_lag) if self.coil_lag > 0 else 0.0
        slider = [self.rate_exponent, self.stiffness, self.damping]
        shares = [self.yield_force, self.yield_share, self.rate_coefficient, self.rate_share]
        state = np.zeros(6)
        state[4:] = self.yield_force * self.yield_share, self.rate_coefficient * self.rate_share
        return np.array([*slider, *shares, self.saturation_current, kept]), state

    def at(self, command: float) -> MrDamper:
        """The damper under a constant current (A)."""
        saturated = math.tanh(abs(command) / self.saturation_current)
        return MrDamper(
            yield_force=self.yield_force * (self.yield_share + (1 - self.yield_share) * saturated),
            rate_coefficient=self.rate_coefficient * (self.rate_share + (1 - self.rate_share) * saturated),
            rate_exponent=self.rate_exponent,
            stiffness=self.stiffness,
            damping=self.damping,
        )

    @staticmethod
    def energise(p, s, w, dt):
        current = abs(w)
        if s[3] == 0.0:
            s[2] = current
            s[3] = 1.0
        s[2] = current + p[8] * (s[2] - current)
        saturated = math.tanh(s[2] / p[7])
        s[4] = p[3] * (p[4] + (1.0 - p[4]) * saturated)
        s[5] = p[5] * (p[6] + (1.0 - p[6]) * saturated)

    @staticmethod
    def step(p, s, x, dt):
        return slid(s[4], s[5], p[0], p[1], p[2], s, x, dt)
