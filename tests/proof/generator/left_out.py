"""Effects concealed in a specimen, as additions to its law: f -> force(...), s' = slopes(...). `series` effects act before it.

Where an effect has two common forms, this is the form that the library does not use: LuGre friction (Canudas de Wit et al.
1995, IEEE Trans. Autom. Control 40, 419-425), soft contact for backlash, heat as a state of energy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from tests.proof.generator.laws import Numbers
from tests.proof.generator.motion import Array

GRID = 1e-3  # s, a twentieth of the time in which a current changes
WIDTHS = (0.9, 1.0, 1.1)  # of the residual current


@dataclass
class At:
    """The state of the motion of a specimen: time, displacement, velocity, acceleration, current (A), temperature (K)."""

    t: float
    x: float
    v: float
    a: float
    current: float
    temperature: float = 293.15


class Effect:
    states = 0

    def start(self, current: float) -> list[float]:
        return [0.0] * self.states

    def prepared(self, current: Callable[[float], float], end: float) -> Effect:
        """The effect with what follows from the current alone until the time `end` (s)."""
        return self

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return []

    def felt(self, at: At, s: Numbers) -> float:
        """The share of the displacement that the law feels."""
        return 1.0

    def felt_rate(self, at: At, s: Numbers, f: float) -> float:
        """The rate of that share, where the law gives the force f."""
        return 0.0


@dataclass
class LuGre(Effect):
    """f += F_c-scaled bristle: x_e z' = v - |v| z / g,  g = 1 + (F_s / F_c - 1) exp(-(v / v_s)^2)"""

    friction: float
    presliding: float
    static: float = 0.0
    stribeck_velocity: float = 1.0
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.friction * s[0]

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        ratio = at.v / self.stribeck_velocity
        most = 1.0 + max(self.static / self.friction - 1.0, 0.0) * math.exp(-ratio * ratio)
        return [(at.v - abs(at.v) * s[0] / most) / self.presliding]


@dataclass
class Heating(Effect):
    """f (1 - phi E),  E' = f v - E / tau; s = phi E. tau = inf keeps the heat."""

    fade: float
    cooling: float = math.inf
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * max(1.0 - s[0], 0.05)

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [self.fade * after * at.v - s[0] / self.cooling]


@dataclass
class Spring(Effect):
    """f + k x + k_3 x^3"""

    stiffness: float = 0.0
    cubic: float = 0.0

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.stiffness * at.x + self.cubic * at.x**3


@dataclass
class Mass(Effect):
    """f + m x''"""

    mass: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.mass * at.a


@dataclass
class Asymmetry(Effect):
    """(1 + a sgn f) f"""

    share: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (1.0 + self.share * math.copysign(1.0, f))


@dataclass
class Power(Effect):
    """f |v / v_r|^e, levelling out below 5 % of v_r"""

    exponent: float
    reference_velocity: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return float(f * math.hypot(at.v / self.reference_velocity, 0.05) ** self.exponent)


@dataclass
class BoucWen(Effect):
    """f + F z,  x_y z' = v - |v| |z|^(n-1) z eta - v |z|^n (1 - eta)"""

    strength: float
    yield_displacement: float
    exponent: float
    fullness: float
    states = 1

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f + self.strength * s[0]

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        z = s[0]
        turned = self.fullness * abs(at.v) * abs(z) ** (self.exponent - 1) * z
        return [(at.v - turned - (1 - self.fullness) * at.v * abs(z) ** self.exponent) / self.yield_displacement]


@dataclass
class Pinch(Effect):
    """f (1 - d exp(-(x / x_p)^2))"""

    depth: float
    width: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (1.0 - self.depth * math.exp(-((at.x / self.width) ** 2)))


@dataclass
class Drop(Effect):
    """f (1 - d) from the moment t_d on"""

    share: float
    time: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (1.0 - self.share) if at.t > self.time else f


@dataclass
class CurrentLag(Effect):
    """f (i_0 + i_f) / (i_0 + i),  tau i_f' = i - i_f"""

    time_constant: float
    zero_current: float
    states = 1

    def start(self, current: float) -> list[float]:
        return [current]

    def force(self, at: At, s: Numbers, f: float) -> float:
        return f * (self.zero_current + s[0]) / (self.zero_current + at.current)

    def slopes(self, at: At, s: Numbers, before: float, after: float) -> list[float]:
        return [(at.current - s[0]) / self.time_constant]


@dataclass
class CurrentStrength(Effect):
    """f (1 - kappa (1 - g(i) / g(i_r))),  g(i) = tanh(i / i_s)"""

    share: float
    saturation: float
    reference: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        full = math.tanh(self.reference / self.saturation)
        return f * (1.0 - self.share * (1.0 - math.tanh(at.current / self.saturation) / full))


@dataclass
class Remanence(Effect):
    """f (i_0 + h) / (i_0 + i): the field h is the mean of three plays of the current, of widths around i_r (Prandtl-Ishlinskii)

    The current does not depend on the specimen. Therefore h is computed first, at every GRID (s).
    """

    residual: float
    zero_current: float
    field: Array | None = None

    def prepared(self, current: Callable[[float], float], end: float) -> Remanence:
        currents = [current(GRID * k) for k in range(int(end / GRID) + 2)]
        held = [currents[0]] * len(WIDTHS)
        fields = []
        for one in currents:
            for place, width in enumerate(WIDTHS):
                held[place] = min(max(held[place], one - width * self.residual), one + width * self.residual)
            fields.append(sum(held) / len(WIDTHS))
        return replace(self, field=np.array(fields))

    def force(self, at: At, s: Numbers, f: float) -> float:
        assert self.field is not None
        place = at.t / GRID
        first = int(place)
        h = self.field[first] + (place - first) * (self.field[first + 1] - self.field[first])
        return f * (self.zero_current + float(h)) / (self.zero_current + at.current)


@dataclass
class Warmth(Effect):
    """f exp(B (1 / T - 1 / T_0)): viscosity over temperature (K) after Andrade (1930). B = beta T_0^2, with beta as at T_0"""

    coefficient: float
    reference: float

    def force(self, at: At, s: Numbers, f: float) -> float:
        reached = self.coefficient * self.reference**2 * (1.0 / at.temperature - 1.0 / self.reference)
        return f * math.exp(reached)


@dataclass
class Series:
    """A massless connection before the specimen: `pulled(d)` is its force and tangent stiffness at the elongation d."""

    def pulled(self, d: float) -> tuple[float, float]:
        raise NotImplementedError


@dataclass
class Compliance(Series):
    """f = d / phi"""

    flexibility: float

    def pulled(self, d: float) -> tuple[float, float]:
        return d / self.flexibility, 1 / self.flexibility


@dataclass
class Play(Series):
    """f = k_s r (ln(1 + e^((d - g/2) / r)) - ln(1 + e^((-d - g/2) / r))): contact springs on both sides, rounded over r."""

    gap: float
    stiffness: float
    rounding: float  # r: far below the elongation under load, else the play is shorter by several r

    def pulled(self, d: float) -> tuple[float, float]:
        rounding = self.rounding
        ahead, behind = (d - self.gap / 2) / rounding, (-d - self.gap / 2) / rounding
        force = self.stiffness * rounding * (_soft(ahead) - _soft(behind))
        return force, self.stiffness * (_step(ahead) + _step(behind))


def _soft(z: float) -> float:
    return z if z > 36.0 else math.log1p(math.exp(max(z, -700.0)))


def _step(z: float) -> float:
    return 1.0 / (1.0 + math.exp(min(-z, 700.0)))
