"""Magneto-rheological damper at constant current (passive-on): Maxwell element in series with a rate-dependent slider."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled
from rths_engine.foundation.part import Part, quantity


@compiled
def slid(a, b, n, k, c, s, x, dt):
    """Force (N) after the displacement moves to x (m); s[0] is the last displacement (m) and s[1] the last force (N)."""
    relax = 1.0 / (1.0 + k * dt / c)
    trial = (s[1] + k * (x - s[0])) * relax
    excess = abs(trial) - a
    force = trial
    if excess > 0.0:
        k_dt = k * dt * relax
        if b <= 0.0:
            strength = a
        else:
            inverse_n = 1.0 / n
            w = min(excess / b, (excess / k_dt) ** n)
            for _ in range(60):
                slip = w**inverse_n
                residual = excess - b * w - k_dt * slip
                change = residual / (b + k_dt * inverse_n * slip / w)
                w += change
                if abs(change) <= 1e-14 * w:
                    break
            strength = a + b * w
        force = strength if trial > 0.0 else -strength
    s[0] = x
    s[1] = force
    return force


class MrDamper(Part):
    """MR damper at constant current (passive-on): Maxwell element in series with a rate-dependent slider.

    f' = k (v - f/c - v_s);   v_s = 0 while |f| <= a, else |f| = a + b |v_s|^n with v_s along f

    The spring k and the dashpot c (the Maxwell element) deform before yield. The slider yields at the force a and hardens with
    its velocity by b and n. The equation is solved implicitly (backward Euler) in w = |v_s|^n. Its residual
    F0 - a - b w - k' dt w^(1/n) is concave and decreasing, so Newton's method converges monotonically from the right.
    x (m), f (N). State: s[0] last displacement (m), s[1] force (N).
    Not valid when the current changes (`mr_damper_current` follows it), when the fluid heats up, or at strokes where the
    accumulator stiffens.
    Form and values after Chae, Ricles and Sause (2013), "Modeling of a large-scale magneto-rheological damper for seismic
    hazard mitigation. Part I: Passive mode", EESD 42, 669-685, for 2.5 A.
    """

    kind: Literal["mr_damper"] = "mr_damper"
    yield_force: float = quantity("Slider yield force a", "N", "kN", ge=0, le=1e8, default=138.5e3)
    rate_coefficient: float = quantity("Slider rate coefficient b", "N*(s/m)^n", "kN*(s/m)^n", ge=0, le=1e9, default=161.8e3)
    rate_exponent: float = quantity("Slider rate exponent n", gt=0.05, le=1, default=0.46)
    stiffness: float = quantity("Maxwell spring stiffness", "N/m", "kN/m", gt=0, le=1e12, default=1.0e8)
    damping: float = quantity("Maxwell dashpot coefficient", "N*s/m", "kN*s/m", gt=0, le=1e12, default=1.0e7)
    title: ClassVar[str] = "MR damper (passive-on)"

    def build(self, dt: float) -> tuple[Array, Array]:
        values = [self.yield_force, self.rate_coefficient, self.rate_exponent, self.stiffness, self.damping]
        return np.array(values), np.zeros(2)

    @staticmethod
    def step(p, s, x, dt):
        return slid(p[0], p[1], p[2], p[3], p[4], s, x, dt)
