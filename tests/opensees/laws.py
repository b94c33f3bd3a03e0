"""Material laws of OpenSees that recordings conceal from a linear plan, and the right names for each in the library."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Material = list[Any]
STRAIGHT = 1.0  # exponent of a linear dashpot


@dataclass(frozen=True)
class Scale:
    """What a law is sized by: largest displacement (m) and velocity (m/s), and the stiffness (N/m) of its linear plan."""

    x: float
    v: float
    stiffness: float
    random: np.random.Generator

    @property
    def force(self) -> float:
        return self.stiffness * self.x

    def between(self, low: float, high: float) -> float:
        return float(self.random.uniform(low, high))


@dataclass(frozen=True)
class Law:
    """A material law and its verdicts.

    `right` are the names of the library that state the law or a part of it. `near` are names of shapes that such a recording
    hardly separates from it. Every other name is wrong. `unknown` is an honest answer to every law that conceals something.
    """

    title: str
    materials: Callable[[Scale], list[Material]]
    right: frozenset[str] = frozenset()
    near: frozenset[str] = frozenset()
    viscous: bool = False  # planned as a dashpot alone, not as a spring with a light dashpot

    @property
    def control(self) -> bool:
        return not self.right


def linear(scale: Scale) -> list[Material]:
    return [["Elastic", scale.stiffness]]


def bilinear(scale: Scale) -> list[Material]:
    return [["Steel01", scale.between(0.25, 0.4) * scale.force, scale.stiffness, scale.between(0.05, 0.15)]]


def smooth_steel(scale: Scale) -> list[Material]:
    """Giuffre, Menegotto and Pinto's curve with the constants of the manual of OpenSees."""
    strength, hardening = scale.between(0.25, 0.4) * scale.force, scale.between(0.03, 0.1)
    return [["Steel02", strength, scale.stiffness, hardening, scale.between(10.0, 20.0), 0.925, 0.15]]


def gap(scale: Scale) -> list[Material]:
    """An elastic spring, and a stop on each side that does not yield."""
    opening, stop, never = scale.between(0.45, 0.6) * scale.x, scale.between(1.0, 3.0) * scale.stiffness, 1e3 * scale.force
    return [*linear(scale), ["ElasticPPGap", stop, never, opening], ["ElasticPPGap", stop, -never, -opening]]


def pinching(scale: Scale) -> list[Material]:
    """A pinched loop that loses strength and stiffness with its dissipated energy and its largest displacement."""
    x, f, wear = scale.x, scale.force, scale.between(0.7, 1.3)
    envelope = [0.25 * f, 0.25 * x, 0.4 * f, 0.5 * x, 0.5 * f, 1.2 * x, 0.4 * f, 2.5 * x]
    pinch = [scale.between(0.4, 0.6), scale.between(0.15, 0.3), 0.02]
    unloading, reloading = [0.4 * wear, 0.2, 0.2 * wear, 0.2, 0.6], [0.3 * wear, 0.3, 0.8, 0.8, 0.3]
    strength = [0.3 * wear, 0.0, 0.5, 0.5, 0.4]
    return [["Pinching4", *envelope, *pinch, *unloading, *reloading, *strength, 10.0, "energy"]]


def self_centring(scale: Scale) -> list[Material]:
    """A flag: it yields at an activation force and returns to zero."""
    activation, after = scale.between(0.25, 0.4) * scale.force, scale.between(0.05, 0.15) * scale.stiffness
    return [["SelfCentering", scale.stiffness, after, activation, scale.between(0.5, 0.9)]]


def power_law(scale: Scale) -> list[Material]:
    """A fluid damper, C |v|^n, on a stiff spring; at 0.6 of the largest velocity it has the force of its linear plan."""
    exponent, reference = scale.between(0.3, 0.5), 0.6 * scale.v
    return [["ViscousDamper", 100.0 * scale.stiffness, scale.force / reference**exponent, exponent]]


def stiffening(scale: Scale) -> list[Material]:
    """k x + k_3 x^3 in eight straight pieces on each side."""
    more = scale.between(0.6, 1.2)
    strains = np.linspace(-2.0, 2.0, 17)
    points, forces = strains * scale.x, scale.force * (strains + more * strains**3)
    return [["ElasticMultiLinear", 0.0, "-strain", *points.tolist(), "-stress", *forces.tolist()]]


HYSTERESIS = frozenset({"bouc_wen_hysteresis", "yielding"})
STOP, HARDENING = frozenset({"gap_contact"}), frozenset({"cubic_stiffness"})
WEAR = frozenset({"pinching", "strength_degradation", "stiffness_degradation", "peak_degradation"})
SLIDER = frozenset({"coulomb_friction", "series_compliance"})  # together they are a slider on a spring: a bilinear loop
HEATED = frozenset({"backlash", "viscous_heating"})  # force that is absent about the centre, or lost with dissipated energy

SPECIMENS = {
    "linear": Law("linear (control)", linear),
    "bilinear": Law("bilinear steel, Steel01", bilinear, HYSTERESIS, SLIDER),
    "smooth_steel": Law("smooth steel, Steel02", smooth_steel, HYSTERESIS, SLIDER),
    "gap": Law("gap, ElasticPPGap", gap, STOP, HARDENING),
    "pinching": Law("pinching and degradation, Pinching4", pinching, WEAR, HYSTERESIS | HEATED),
    "self_centring": Law("self-centring, SelfCentering", self_centring, frozenset({"self_centring"}), frozenset({"softening"})),
    "power_law": Law("power-law damper, ViscousDamper", power_law, frozenset({"velocity_exponent"}), viscous=True),
    "stiffening": Law("stiffening, ElasticMultiLinear", stiffening, HARDENING, STOP),
}
STRUCTURES = {name: law for name, law in SPECIMENS.items() if name not in ("smooth_steel", "power_law")}


def dashpot(coefficient: float) -> Material:
    return ["Viscous", coefficient, STRAIGHT]


def light_damping(scale: Scale) -> float:
    """Coefficient (N s/m) of a dashpot with 8 % of the spring's force at the largest velocity."""
    return 0.08 * scale.force / scale.v


def critical(mass: float, stiffness: float) -> float:
    return 2.0 * math.sqrt(mass * stiffness)
