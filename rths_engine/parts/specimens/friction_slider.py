"""Friction slider with slack."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity


class FrictionSlider(Part):
    """Friction slider with slack.

    f = k sgn(u) max(|u| - g, 0),  u = x - x_s;  the slider x_s moves so that |f| <= f_s

    A Coulomb slider (slip force f_s) in series with a spring k and a slack (free play g in each direction, as in worn pins).
    Exact return mapping; rate-independent. A closed cycle of amplitude X dissipates 4 f_s (X - g - f_s / k), or nothing for a
    smaller X.
    x (m), f (N). State: s[0] slider displacement (m).
    Not valid where static friction exceeds kinetic friction (stick-slip) and where impact at the end of the slack matters.
    Source: Coulomb's law with the spring-slider element of Iwan (1966), J. Appl. Mech. 33, 893-900, and a symmetric gap.
    """

    kind: Literal["friction_slider"] = "friction_slider"
    slip_force: float = quantity("Slip force f_s", "N", "kN", ge=0, le=1e9, default=1.0e5)
    stiffness: float = quantity("Stiffness before slip k", "N/m", "kN/m", gt=0, le=1e12, default=1.0e8)
    slack: float = quantity("Slack in each direction g", "m", "mm", ge=0, le=1, default=0.0)
    title: ClassVar[str] = "Friction slider with slack"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.slip_force, self.stiffness, self.slack, self.slack + self.slip_force / self.stiffness]), np.zeros(
            1
        )

    @staticmethod
    def step(p, s, x, dt):
        u = x - s[0]
        side = 1.0 if u > 0.0 else -1.0
        if abs(u) >= p[3]:
            s[0] = x - side * p[3]
            return side * p[0]
        return side * p[1] * max(abs(u) - p[2], 0.0)
