"""The rig of a case: its true numbers and those of its plan."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np

from tests.proof.generator.case import Truth
from tests.proof.generator.motion import Array
from tests.proof.generator.noise import Colour
from tests.proof.generator.rig import LINEAR, SLIDER_MAXWELL, TANGENT, rig
from tests.proof.generator.rig_effects import OUTSIDE, SUSTAINED, Left, effect
from tests.proof.generator.sizing import Absorbed, sized

LAWS = {"linear": LINEAR, "mr_damper": SLIDER_MAXWELL, "hyperbolic_tangent": TANGENT}
# effects that are numbers of the law itself, and so no effect of that law
OWN = {"linear": {"parallel_stiffness"}, "mr_damper": set(), "hyperbolic_tangent": {"parallel_stiffness"}}
TOLERANCE = 0.05  # of the numbers of an actuator
SPEED = 2.0  # m/s, the most of an actuator


class Bench:
    """The rig of one case: its true numbers, its plan's, and what is the same in its recordings."""

    def __init__(self, seed: int, level: str, law: str, second: bool) -> None:
        self.random = random = np.random.default_rng(seed)
        self.seed, self.level, self.law = seed, level, law
        self.rate = float(random.choice([512, 1024]))
        self.duration = float(random.uniform(15, 28))
        self.small = 0.2 if level == "small" else 1.0
        self.peak = float(np.exp(random.uniform(np.log(0.015), np.log(0.05)))) * self.small
        self.actuator = _second_order(random) if second else {"alpha": float(random.uniform(5, 30)) * self.rate / 1024}
        self.specimen = own_specimen(random, law)

    @property
    def step(self) -> float:
        return 1 / self.rate

    def rig(
        self, lefts: list[Left], actuator: dict[str, float] | None = None, specimen: dict[str, float] | None = None
    ) -> Array:
        own = _numbers(actuator or self.actuator, self.step) | _law(self.law, specimen or self.specimen)
        return rig(
            **own, **{key: value for one in lefts for key, value in one.numbers.items() if key != "speed"}, **_speed(lefts)
        )

    def planned(self) -> tuple[dict[str, float], dict[str, float]]:
        """Actuator and specimen as the plan has them."""
        random = self.random
        actuator = {key: value * (1 + random.uniform(-0.03, 0.03)) for key, value in self.actuator.items()}
        actuator |= {"alpha": max(actuator["alpha"], 1.0)} if "alpha" in actuator else {}
        return actuator, {key: value * (1 + random.uniform(-0.04, 0.04)) for key, value in self.specimen.items()}

    def station(self, compensator: dict[str, Any]) -> dict[str, Any]:
        actuator, specimen = self.planned()
        kind = "second_order" if "frequency" in actuator else "first_order_delay"
        return {
            "name": "Station",
            "compensator": compensator,
            "actuator": {"kind": kind, "velocity_limit": SPEED, **actuator},
            "specimen": {"kind": self.law, **specimen},
            "limits": {"displacement": 1.0, "velocity": 2.0, "force": 1e8},
        }


def _second_order(random: np.random.Generator) -> dict[str, float]:
    frequency, damping = float(random.uniform(8, 25)), float(random.uniform(0.6, 1.1))
    return {"frequency": frequency, "damping_ratio": damping, "dead_time": float(random.uniform(0.003, 0.012))}


def own_specimen(random: np.random.Generator, law: str) -> dict[str, float]:
    def around(value: float, spread: float) -> float:
        return float(value * spread ** random.uniform(-1, 1))

    match law:
        case "linear":
            return {"stiffness": around(1e6, 2), "damping": around(2.5e5, 1.5)}
        case "mr_damper":
            values = {"yield_force": 1.2e5, "rate_coefficient": 1.4e5, "rate_exponent": 0.46, "stiffness": 8e7, "damping": 1e7}
            return {key: around(value, 1.2 if key == "rate_exponent" else 1.4) for key, value in values.items()}
        case _:
            values = {"yield_force": 1e5, "velocity_scale": 0.03, "displacement_scale": 0.06, "stiffness": 3e5, "damping": 8e4}
            return {key: around(value, 1.5) for key, value in values.items()}


def _numbers(actuator: dict[str, float], step: float) -> dict[str, float]:
    if "alpha" in actuator:
        return {"order": 1, "time_constant": -step / math.log(1 - 1 / actuator["alpha"])}
    omega = 2 * math.pi * actuator["frequency"]
    return {"order": 2, "omega": omega, "zeta": actuator["damping_ratio"], "dead_time": actuator["dead_time"]}


def _law(law: str, specimen: dict[str, float]) -> dict[str, float]:
    names = {
        "yield_force": "a",
        "rate_coefficient": "b",
        "rate_exponent": "n",
        "stiffness": "k",
        "damping": "c",
        "velocity_scale": "v_0",
        "displacement_scale": "x_0",
    }
    return {"law": LAWS[law], **{names[key]: value for key, value in specimen.items()}}


def _speed(lefts: list[Left]) -> dict[str, float]:
    return {"speed": min([SPEED, *(one.numbers["speed"] for one in lefts if "speed" in one.numbers)])}


def coloured(random: np.random.Generator, level: str, signal: Array, step: float) -> Colour:
    share = np.exp(random.uniform(np.log(0.02), np.log(0.06))) if level == "noise" else random.uniform(0.004, 0.02)
    corner = float(np.exp(random.uniform(np.log(5.0), np.log(60.0))))
    return Colour(float(share * np.std(signal)), step, corner, float(random.uniform(0, 0.25)))


def seen_of(x: Array, f: Array, step: float) -> dict[str, float]:
    v = np.gradient(x, step)
    peaks = {key: float(np.max(np.abs(one))) for key, one in (("x", x), ("v", v), ("f", f))}
    drawn, most = 0.0, 0.0  # from an accumulator: the longest way beyond what SUSTAINED of the largest speed gives
    for moved in np.abs(np.diff(x)).tolist():
        drawn = max(drawn + moved - SUSTAINED * peaks["v"] * step, 0.0)
        most = max(most, drawn)
    return {**peaks, "energy": float(np.sum(np.abs(f * v)) * step), "time": len(x) * step, "drawn": most}


def sized_effect(absorbed: Absorbed, out: Any, seed: int, name: str, wanted: float, seen: dict[str, float]) -> Left:
    def strength_of(size: float) -> float:
        return absorbed.strength(out([effect(seed + 1, name, size, seen)]))

    first, most = {"velocity_saturation": (0.3, 0.9), "force_compliance": (0.02, 0.2)}.get(name, (0.03, 0.6))
    return effect(seed + 1, name, sized(strength_of, wanted, first, most), seen)


def truth_of(
    kind: str, bench: Bench, lefts: list[Left], names: list[str], strength: float | None, noise: Colour, output: str
) -> Truth:
    hidden = names[0] if names and names[0] in OUTSIDE else None
    told = [] if hidden else [one.told() for one in lefts]
    component = lefts[0].component if lefts else ""
    about = {"component": component, "law": bench.law, "rate": bench.rate, "actuator": sorted(bench.actuator)[0]}
    true = {"actuator": bench.actuator, "specimen": bench.specimen}
    return Truth(kind, bench.level, bench.seed, told, hidden, strength, true, asdict(noise), output, about)
