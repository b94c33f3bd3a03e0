"""Effects to conceal in a specimen, by name and size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.proof.generator.left_out import (
    Asymmetry,
    BoucWen,
    Compliance,
    CurrentLag,
    CurrentStrength,
    Drop,
    Effect,
    Heating,
    LuGre,
    Mass,
    Pinch,
    Play,
    Power,
    Remanence,
    Series,
    Spring,
    Warmth,
)
from tests.proof.generator.readings import Reading, reading
from tests.proof.generator.wearing import (
    CheckValve,
    PeakLoss,
    Pendulum,
    RingSpring,
    Sticking,
    StiffnessLoss,
    Stop,
    StrengthLoss,
)

IDS = (
    "coulomb_friction",
    "stribeck_friction",
    "backlash",
    "viscous_heating",
    "series_compliance",
    "parallel_stiffness",
    "cubic_stiffness",
    "added_inertia",
    "asymmetry",
    "velocity_exponent",
    "bouc_wen_hysteresis",
    "pinching",
    "strength_drop",
    "current_lag",
    "strength_degradation",
    "peak_degradation",
    "stiffness_degradation",
    "self_centring",
    "pendulum_friction",
    "gap_contact",
    "asymmetric_viscosity",
    "stick_slip",
    "strength_against_current",
    "residual_field",
    "strength_against_temperature",
)
PAIRED = IDS[:14]  # of which pairs are drawn: the others are sums or near relatives of some of these
CURRENT = {"current_lag", "strength_against_current", "residual_field"}  # seen only where the current changes
COMMANDED = CURRENT | {"strength_against_temperature"}
# effects that are numbers of the law itself, and so no effect of that law
OWN = {
    "linear": {"parallel_stiffness", "stiffness_degradation", "pendulum_friction"},
    "mr_damper": {"series_compliance"},
    "hyperbolic_tangent": {"parallel_stiffness", "pendulum_friction"},
    "friction_slider": {"backlash", "series_compliance", "coulomb_friction", "stiffness_degradation", "pendulum_friction"},
}
FIRST, MOST = 0.05, 0.6  # of the force, where the search for a size begins and ends
SOFT = 1e-6  # m, what the contact springs of a play give way at the largest force
PLACED = {"backlash", "series_compliance"}
FACTORS = {"viscous_heating", "asymmetry", "strength_drop"}


@dataclass
class Left:
    """An effect of the truth: as it acts, and as it is told."""

    id: str
    component: str
    acts: Effect | Series | Reading
    parameters: dict[str, float]
    form: str = ""

    def told(self) -> dict[str, Any]:
        return {"component": self.component, "id": self.id, "form": self.form, "parameters": self.parameters}


def effect(seed: int, name: str, size: float, scale: dict[str, float]) -> Left:
    """Effect `name` of about `size` of the force; the same seed draws the same for every size."""
    random = np.random.default_rng(seed)
    f, x, v = scale["f"], scale["x"], scale["v"]
    sign = float(random.choice([-1.0, 1.0]))

    def left(acts: Effect | Series, form: str = "", **parameters: float) -> Left:
        return Left(name, "specimen:1", acts, parameters, form)

    match name:
        case "coulomb_friction":
            presliding = x * random.uniform(0.003, 0.02)
            return left(LuGre(size * f, presliding), "LuGre", friction=size * f)
        case "stribeck_friction":
            friction, more, slow = size * f, random.uniform(1.5, 3.0), v * random.uniform(0.03, 0.15)
            acts = LuGre(friction, x * random.uniform(0.003, 0.01), more * friction, slow)
            return left(acts, "LuGre", friction=friction, breakaway=(more - 1) * friction, stribeck_velocity=slow)
        case "backlash":
            return left(Play(size * x, f / SOFT, 0.1 * SOFT), "soft contact", gap=size * x)
        case "viscous_heating":
            return left(Heating(size / scale["energy"]), "heat as a state", fade=size / scale["energy"])
        case "series_compliance":
            return left(Compliance(size * x / f), flexibility=size * x / f)
        case "parallel_stiffness":
            return left(Spring(stiffness=sign * size * f / x), stiffness=sign * size * f / x)
        case "cubic_stiffness":
            return left(Spring(cubic=sign * size * f / x**3), stiffness=sign * size * f / x**3)
        case "added_inertia":
            return left(Mass(size * f / scale["a"]), mass=size * f / scale["a"])
        case "asymmetry":
            return left(Asymmetry(sign * size), share=sign * size)
        case "velocity_exponent":
            return left(Power(sign * size, 0.5 * v), "without levelling", exponent=sign * size)
        case "bouc_wen_hysteresis":
            x_y, n, eta = x * random.uniform(0.03, 0.15), random.uniform(1, 3), random.uniform(0.5, 0.8)
            return left(BoucWen(size * f, x_y, n, eta), strength=size * f, yield_displacement=x_y, exponent=n, fullness=eta)
        case "pinching":
            width = x * random.uniform(0.1, 0.35)
            return left(Pinch(size, width), depth=size, width=width)
        case "strength_drop":
            moment = scale["time"] * random.uniform(0.3, 0.8)
            return left(Drop(size, moment), share=size, time=moment)
        case "current_lag":
            zero = random.uniform(0.5, 2.0)
            return left(CurrentLag(size, zero), time_constant=size, zero_current=zero)
        case "strength_degradation":
            energy = scale["energy"] * random.uniform(0.1, 0.4)
            return left(StrengthLoss(size, energy), "energy as a state", share=size, energy=energy)
        case "peak_degradation":
            return left(PeakLoss(size / x, x), "peak as a state", rate=size / x)
        case "stiffness_degradation":
            energy = scale["energy"] * random.uniform(0.1, 0.4)
            return left(StiffnessLoss(size, energy), "energy as a state", share=size, energy=energy)
        case "self_centring":
            opening, width = x * random.uniform(0.05, 0.2), random.uniform(0.4, 0.9)
            flag = RingSpring(size * f, opening, width)
            return left(flag, "preloaded slider", strength=size * f, opening=opening, width=width)
        case "pendulum_friction":
            slow, rise, presliding = random.uniform(0.4, 0.6), v * random.uniform(0.1, 0.3), x * random.uniform(0.003, 0.02)
            bearing = Pendulum(size * f / x, size * f, rise, slow, presliding)
            return left(bearing, "LuGre", stiffness=size * f / x, friction=size * f, velocity=rise)
        case "gap_contact":
            gap, hardening = x * random.uniform(0.5, 0.8), random.uniform(0.5, 3.0) / x
            stop = size * f / ((x - gap) * (1 + hardening * (x - gap)))
            return left(Stop(gap, stop, hardening, 1e-3 * x), "soft contact", gap=gap, stiffness=stop, hardening=hardening)
        case "asymmetric_viscosity":
            return left(CheckValve(sign * size * f / v), damping=sign * size * f / v)
        case "stick_slip":
            release = x * random.uniform(0.03, 0.2)
            return left(Sticking(size * f, release), "bristles as states", force=size * f, release=release)
        case "strength_against_current":
            saturation, full = random.uniform(0.5, 1.5), scale["current"]
            law = CurrentStrength(sign * size, saturation, full)
            return left(law, share=sign * size, saturation_current=saturation, reference_current=full)
        case "residual_field":
            zero = random.uniform(0.5, 2.0)
            return left(Remanence(size, zero), "Prandtl-Ishlinskii", residual=size, off_current=zero)
        case "strength_against_temperature":
            coefficient, reference = 0.1 * sign * size, scale["temperature"]
            return left(Warmth(coefficient, reference), "Andrade", coefficient=coefficient, reference=reference)
        case _:
            error, parameters = reading(random, name.removeprefix("sensor_"), size, f, scale["time"])
            return Left(name.removeprefix("sensor_"), "sensor:f_meas.1", error, parameters)


def most(name: str) -> float:
    """Where the search for a size ends: physics outside the library may be of any size but for factors of the force."""
    return 20.0 if name in ("fractional_creep", "cogging", "self_pumping", "cubic_memory") else MOST
