"""Physics outside the library of effects, for which the right verdict is `unknown`."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from tests.proof.generator.laws import Numbers
from tests.proof.generator.left_out import At, Effect


@dataclass
class FractionalCreep(Effect):
    """f + C D^alpha x by Maxwell branches whose relaxation times are spaced by factors of 3 from 1 ms to 66 s; s in m."""

    coefficient: float
    order: float
    times: list[float] = field(default_factory=lambda: [1e-2 * 3.0**k for k in range(9)])
    states = 9

    def weights(self) -> list[float]:
        base = math.log(3.0) / math.gamma(self.order) / math.gamma(1 - self.order)
        return [base * self.coefficient * tau**-self.order for tau in self.times]

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + sum(w * one for w, one in zip(self.weights(), s, strict=True))

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [at.v - one / tau for one, tau in zip(s, self.times, strict=True)]


@dataclass
class Cogging(Effect):
    """f + F sin(2 pi x / p + q)"""

    strength: float
    pitch: float
    phase: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.strength * (math.sin(2 * math.pi * at.x / self.pitch + self.phase) - math.sin(self.phase))


@dataclass
class HardeningByTravel(Effect):
    """f (1 + h max(n - 1, 0)^0.6),  n = travel / (4 x_r N)"""

    share: float
    travel: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return float(f * (1.0 + self.share * max(s[0] - 1.0, 0.0) ** 0.6))

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [abs(at.v) / self.travel]


@dataclass
class SelfPumping(Effect):
    """f + F s,  tau s' = |v| / v_r - s: motion pumps up a pressure that leaks away"""

    strength: float
    velocity: float
    leaking: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.strength * s[0]

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [(abs(at.v) / self.velocity - s[0]) / self.leaking]


@dataclass
class CubicMemory(Effect):
    """f + c w^3,  tau w' = v - w"""

    coefficient: float
    memory: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.coefficient * s[0] ** 3

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [(at.v - s[0]) / self.memory]


@dataclass
class PumpRipple(Effect):
    """f (1 + e sin(2 pi f_r t))"""

    share: float
    frequency: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (1.0 + self.share * math.sin(2 * math.pi * self.frequency * at.t))


def drawn(random: np.random.Generator, name: str, size: float, scale: dict[str, float]) -> Effect:
    """The law of a name in NAMES; `size` is its approximate share of the force."""
    f, x, v, duration = scale["f"], scale["x"], scale["v"], scale["time"]
    match name:
        case "fractional_creep":
            return FractionalCreep(size * f / x, random.uniform(0.3, 0.6))
        case "cogging":
            return Cogging(size * f, x * random.uniform(0.15, 0.5), random.uniform(0, 2 * math.pi))
        case "hardening_by_travel":
            return HardeningByTravel(size, scale["travel"] * random.uniform(0.2, 0.4))
        case "self_pumping":
            return SelfPumping(size * f, v, random.uniform(0.3, 1.0))
        case "cubic_memory":
            return CubicMemory(size * f / v**3, random.uniform(0.03, 0.1))
        case _:
            return PumpRipple(size, random.uniform(3.0, 7.0) / duration)


NAMES = ("fractional_creep", "cogging", "hardening_by_travel", "self_pumping", "cubic_memory", "pump_ripple")
