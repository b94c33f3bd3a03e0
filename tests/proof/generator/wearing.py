"""Effects concealed in a specimen that wears, slides or strikes, as additions to its law (`left_out`).

The forms are others than those of the library where there are two: a preloaded slider behind a spring for self-centring, LuGre
friction for the pendulum, soft contact for the stop, states of differential equations for energy and peaks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from tests.proof.generator.laws import Numbers
from tests.proof.generator.left_out import At, Effect

CREEP = 1e-4  # s: how long the slider of a self-centring element takes to follow
ROUNDED = 5e-3  # of the opening displacement: over which the preload turns


@dataclass
class StrengthLoss(Effect):
    """f (1 - d (1 - exp(-s))),  E_d s' = f v"""

    share: float
    energy: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (1.0 + self.share * math.expm1(-max(s[0], 0.0)))

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [after * at.v / self.energy]


@dataclass
class PeakLoss(Effect):
    """f exp(-kappa m); x_r s' = |v| where |x| exceeds s x_r and grows, so that s x_r follows the largest |x|"""

    rate: float
    scale: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * math.exp(-self.rate * max(s[0] * self.scale, abs(at.x)))

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [abs(at.v) / self.scale if abs(at.x) >= s[0] * self.scale and at.x * at.v > 0.0 else 0.0]


@dataclass
class StiffnessLoss(Effect):
    """The law feels u = x (1 - d (1 - exp(-s))),  E_d s' = f v"""

    share: float
    energy: float
    states = 1

    def felt(self, at: At, s: Numbers) -> float:
        return 1.0 + self.share * math.expm1(-max(s[0], 0.0))

    def felt_rate(self, at: At, s: Numbers, f: float) -> float:
        return -self.share * math.exp(-max(s[0], 0.0)) * f * at.v / self.energy

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [after * at.v / self.energy]


@dataclass
class RingSpring(Effect):
    """f + F z,  z = x / x_a - s: a spring before a slider with the preload 1 - b/2 to both sides and the friction b/2"""

    strength: float
    opening: float
    width: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.strength * (at.x / self.opening - s[0])

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        preload = (1.0 - self.width / 2) * min(max(s[0] / ROUNDED, -1.0), 1.0)
        pushed = at.x / self.opening - s[0] - preload
        return [math.copysign(max(abs(pushed) - self.width / 2, 0.0), pushed) / CREEP]


@dataclass
class Pendulum(Effect):
    """f + k x + F s,  x_e s' = v - |v| s / (1 - r exp(-|v| / v_c))"""

    stiffness: float
    friction: float
    velocity: float
    slow: float
    presliding: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.stiffness * at.x + self.friction * s[0]

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        most = 1.0 - self.slow * math.exp(-abs(at.v) / self.velocity)
        return [(at.v - abs(at.v) * s[0] / most) / self.presliding]


@dataclass
class Stop(Effect):
    """f + k d (1 + h d) on both sides,  d = r ln(1 + e^((|x| - g) / r))"""

    gap: float
    stiffness: float
    hardening: float
    rounding: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        beyond = (abs(at.x) - self.gap) / self.rounding
        deep = self.rounding * (beyond if beyond > 36.0 else math.log1p(math.exp(max(beyond, -700.0))))
        return f + math.copysign(self.stiffness * deep * (1.0 + self.hardening * deep), at.x)


@dataclass
class CheckValve(Effect):
    """f + c |v|"""

    damping: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.damping * abs(at.v)


@dataclass
class Sticking(Effect):
    """f + F (s_1 - s_2) / 1.394,  0.1 x_s s_1' = v - |v| s_1,  x_s s_2' = v - |v| s_2"""

    strength: float
    release: float
    states = 2

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.strength * (s[0] - s[1]) / 1.3936

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [(at.v - abs(at.v) * s[0]) / (0.1 * self.release), (at.v - abs(at.v) * s[1]) / self.release]
