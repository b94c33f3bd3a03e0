"""Effects to conceal in a structure or in the ground motion that it feels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.proof.generator import structure as physics
from tests.proof.generator.structure import Element, Whole

WHOLE = ("damping_error", "p_delta", "base_flexibility")
INPUT = ("scale_error", "time_shift", "low_pass", "baseline_drift")
IDS = (
    "stiffness_error",
    "mass_error",
    "damping_error",
    "coulomb_friction",
    "quadratic_damping",
    "cubic_stiffness",
    "yielding",
    "bouc_wen_hysteresis",
    "pinching",
    "gap_contact",
    "p_delta",
    "base_flexibility",
    "stiffness_drop",
    "softening",
    "stiffness_degradation",
    "self_centring",
)
PAIRED = IDS[:13]  # of which pairs are drawn: the others are near relatives of some of these
OUTSIDE = ("cubic_memory", "healing_softening", "cogging", "parametric_stiffness", "one_sided_cubic_damping")


@dataclass
class Left:
    """An effect of the truth: of storeys, of the whole, or of the ground motion that the structure feels."""

    id: str
    component: str
    parameters: dict[str, float]
    elements: tuple[Element, ...] = ()
    whole: Whole | None = None
    ground: dict[str, float] | None = None

    def told(self) -> dict[str, Any]:
        return {"component": self.component, "id": self.id, "form": "", "parameters": self.parameters}


def effect(seed: int, name: str, size: float, seen: dict[str, Any]) -> Left:
    """`seen`: drifts' peaks and storey stiffnesses of the plain structure."""
    random = np.random.default_rng(seed)
    storey = int(random.integers(1, len(seen["d"]) + 1))
    d, v, k = seen["d"][storey - 1], seen["v"][storey - 1], seen["k"][storey - 1]
    sign, f, component = float(random.choice([-1.0, 1.0])), k * d, f"structure:{storey}"

    def of(
        element: Element | None = None, whole: Whole | None = None, ground: dict[str, float] | None = None, **told: float
    ) -> Left:
        place = "input" if ground else "structure" if name in WHOLE else component
        return Left(name.removeprefix("input_"), place, told, (element,) if element else (), whole, ground)

    match name:
        case "stiffness_error":
            return of(whole=Whole(stiffness={storey: sign * size}), share=sign * size)
        case "mass_error":
            return of(whole=Whole(mass={storey: sign * size}), share=sign * size)
        case "damping_error":
            return of(whole=Whole(damping=4 * size), share=4 * size)
        case "p_delta":
            return of(whole=Whole(gravity=size), load=size)
        case "base_flexibility":
            return of(whole=Whole(base=size / seen["k"][0]), flexibility=size / seen["k"][0])
        case "coulomb_friction":
            return of(Element(storey, physics.FRICTION, (0.5 * size * f, 0.01 * d)), friction=0.5 * size * f)
        case "quadratic_damping":
            return of(Element(storey, physics.QUADRATIC, (size * f / v**2,)), coefficient=size * f / v**2)
        case "cubic_stiffness":
            cubic = (1.0 if sign > 0 else -0.5) * size * f / d**3
            return of(Element(storey, physics.CUBIC, (cubic,)), stiffness=cubic)
        case "yielding":
            strength, ratio = max(1.0 - size, 0.05) * f, random.uniform(0.05, 0.4)
            return of(Element(storey, physics.YIELDING, (strength, ratio)), yield_force=strength, post_yield_ratio=ratio)
        case "bouc_wen_hysteresis":
            numbers = (size * f, d * random.uniform(0.05, 0.2), random.uniform(1, 3), random.uniform(0.5, 0.8))
            names = ("strength", "yield_displacement", "exponent", "fullness")
            return of(Element(storey, physics.HYSTERESIS, numbers), **dict(zip(names, numbers, strict=True)))
        case "pinching":
            width = d * random.uniform(0.1, 0.3)
            return of(Element(storey, physics.PINCHING, (size, width)), depth=size, width=width)
        case "gap_contact":
            gap, stop = d * random.uniform(0.3, 0.7), 3 * size * k
            return of(Element(storey, physics.GAP, (gap, stop)), gap=gap, stiffness=stop)
        case "stiffness_drop":
            moment = seen["time"] * random.uniform(0.25, 0.6)
            return of(Element(storey, physics.DROP, (size, moment)), share=size, time=moment)
        case "softening":
            drift = d * random.uniform(0.1, 0.5)
            return of(Element(storey, physics.SOFTENING, (size, drift)), share=size, drift=drift)
        case "stiffness_degradation":
            energy = k * d**2 * random.uniform(3.0, 10.0)
            return of(Element(storey, physics.TURNED, (size, energy)), share=size, energy=energy)
        case "self_centring":
            opening, width = d * random.uniform(0.1, 0.3), random.uniform(0.4, 0.9)
            flag = Element(storey, physics.FLAG, (size * f, opening, width))
            return of(flag, strength=size * f, opening=opening, width=width)
        case "input_scale_error":
            return of(ground={"scale": sign * size}, share=sign * size)
        case "input_time_shift":
            return of(ground={"shift": 0.2 * size}, delay=0.2 * size)
        case "input_low_pass":
            return of(ground={"low_pass": 0.2 * size}, time_constant=0.2 * size)
        case "input_baseline_drift":
            b, c = sign * 0.3 * size * seen["a"], size * seen["a"] * random.uniform(-0.3, 0.3) / seen["time"]
            return of(ground={"offset": b, "rate": c}, offset=b, rate=c)
        case _:
            return of(strange(random, name, storey, size, d, v, f, seen["time"]), size=size)


def strange(
    random: np.random.Generator, name: str, storey: int, size: float, d: float, v: float, f: float, lasting: float
) -> Element:
    """Physics that the library does not hold."""
    match name:
        case "cubic_memory":
            return Element(storey, physics.MEMORY, (size * f, v, random.uniform(0.05, 0.2)))
        case "healing_softening":
            return Element(storey, physics.HEALING, (size, d * random.uniform(3, 8), lasting * random.uniform(0.05, 0.15)))
        case "cogging":
            return Element(storey, physics.COGGING, (size * f, d * random.uniform(0.15, 0.4)))
        case "parametric_stiffness":
            return Element(storey, physics.PARAMETRIC, (size, random.uniform(2.0, 5.0) / lasting))
        case _:
            return Element(storey, physics.ONE_SIDED, (size * f / v**3,))
