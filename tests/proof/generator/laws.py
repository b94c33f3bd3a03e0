"""Laws of specimens as differential equations: the force from displacement u, its rate v and states of order one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from tests.proof.generator.motion import Array, Motion

Numbers = Sequence[float]


class Law:
    """f = force(t, u, v, s), s' = slopes(t, u, v, s). `rate` is the inverse: u' from the force of a spring in series."""

    states = 0

    def prepared(self, motion: Motion) -> Law:
        """The law for one motion; a rate-independent law is solved over the whole motion first."""
        return self

    def force(self, t: float, u: float, v: float, s: Numbers) -> float:
        raise NotImplementedError

    def slopes(self, t: float, u: float, v: float, s: Numbers) -> list[float]:
        return []

    def rate(self, u: float, f: float, stiffness: float, x_rate: float) -> float:
        """u' of a specimen with the force f behind a spring of tangent `stiffness` whose other end moves with x_rate."""
        raise NotImplementedError


@dataclass
class Linear(Law):
    """f = k u + c v"""

    stiffness: float
    damping: float

    def force(self, t: float, u: float, v: float, s: Numbers) -> float:
        return self.stiffness * u + self.damping * v

    def rate(self, u: float, f: float, stiffness: float, x_rate: float) -> float:
        return (f - self.stiffness * u) / self.damping


@dataclass
class SliderMaxwell(Law):
    """f' = k (v - f/c - v_s),  v_s = sgn(f) ((|f| - a) / b)^(1/n) beyond |f| = a;  s = f / a."""

    yield_force: float
    rate_coefficient: float
    rate_exponent: float
    stiffness: float
    damping: float
    states = 1

    def slip(self, f: float) -> float:
        excess = abs(f) - self.yield_force
        slip = (excess / self.rate_coefficient) ** (1 / self.rate_exponent) if excess > 0 else 0.0
        return f / self.damping + math.copysign(slip, f)

    def force(self, t: float, u: float, v: float, s: Numbers) -> float:
        return s[0] * self.yield_force

    def slopes(self, t: float, u: float, v: float, s: Numbers) -> list[float]:
        return [self.stiffness * (v - self.slip(s[0] * self.yield_force)) / self.yield_force]

    def rate(self, u: float, f: float, stiffness: float, x_rate: float) -> float:
        share = stiffness / self.stiffness
        return (share * x_rate + self.slip(f)) / (1 + share)


@dataclass
class HyperbolicTangent(Law):
    """f = k u + c v + f_0 tanh(v / v_0 + u / x_0)"""

    yield_force: float
    velocity_scale: float
    displacement_scale: float
    stiffness: float
    damping: float

    def force(self, t: float, u: float, v: float, s: Numbers) -> float:
        bent = math.tanh(v / self.velocity_scale + u / self.displacement_scale)
        return self.stiffness * u + self.damping * v + self.yield_force * bent

    def rate(self, u: float, f: float, stiffness: float, x_rate: float) -> float:
        lean, left = u / self.displacement_scale, f - self.stiffness * u
        most = 1.000001 * self.yield_force + 1e-9 * abs(left)  # beyond the last digit in which tanh is below one
        low, high = (left - most) / self.damping, (left + most) / self.damping
        return float(
            brentq(lambda v: self.damping * v + self.yield_force * math.tanh(v / self.velocity_scale + lean) - left, low, high)
        )


@dataclass
class Slider(Law):
    """f = k (u - u_s), the slider u_s following so that |f| <= f_s: solved exactly from turning point to turning point."""

    slip_force: float
    stiffness: float
    slack: float = 0.0

    def prepared(self, motion: Motion) -> Law:
        time = np.unique(np.concatenate([np.arange(0, motion.duration, motion.step), motion.turning(), [motion.duration]]))
        return Path(time, self.over(motion.sample(time)))

    def over(self, displacement: Array) -> Array:
        reach, at, force = self.slip_force / self.stiffness, 0.0, []
        for x in displacement.tolist():
            at = min(max(at, x - reach), x + reach)
            force.append(self.stiffness * (x - at))
        return np.array(force)


class Path(Law):
    """A force that is given over time."""

    def __init__(self, time: Array, force: Array) -> None:
        self.time, self.values, self.hint = time, force, 0

    def force(self, t: float, u: float, v: float, s: Numbers) -> float:
        return float(np.interp(t, self.time, self.values))


LAWS = {"linear": Linear, "mr_damper": SliderMaxwell, "hyperbolic_tangent": HyperbolicTangent, "friction_slider": Slider}
