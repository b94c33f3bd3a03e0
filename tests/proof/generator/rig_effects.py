"""Effects to conceal in a rig, as numbers of it or as an error of a reading."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.proof.generator.readings import Reading, reading

ACTUATOR = (
    "delay_error",
    "amplitude_dependent_delay",
    "second_order_lag",
    "velocity_saturation",
    "force_compliance",
    "dead_band",
    "backlash",
    "stick_friction",
    "gain_error",
    "valve_flow",
    "supply_saturation",
)
SUSTAINED = 0.5  # of the largest speed: what a pump gives alone
PAIRED = ACTUATOR[:9]  # of which pairs are drawn: the others act through the load, or are relatives of these
SPECIMEN = (
    "coulomb_friction",
    "stribeck_friction",
    "viscous_heating",
    "parallel_stiffness",
    "cubic_stiffness",
    "asymmetry",
    "velocity_exponent",
    "bouc_wen_hysteresis",
    "pinching",
    "strength_drop",
)
OUTSIDE = ("uneven_speed", "rate_dependent_gain", "hysteretic_position", "wandering_speed")


@dataclass
class Left:
    """An effect of the truth: numbers of the rig, or an error of a reading."""

    id: str
    component: str
    numbers: dict[str, float]
    parameters: dict[str, float]
    reading: Reading | None = None

    def told(self) -> dict[str, Any]:
        return {"component": self.component, "id": self.id, "form": "", "parameters": self.parameters}


def effect(seed: int, name: str, size: float, seen: dict[str, float]) -> Left:
    """Effect `name` of about `size` of the displacement or the force; `actuator_backlash` is of the actuator."""
    random = np.random.default_rng(seed)
    x, v, f, time = seen["x"], seen["v"], seen["f"], seen["time"]
    sign = float(random.choice([-1.0, 1.0]))

    def actuator(numbers: dict[str, float], **told: float) -> Left:
        return Left(name, "actuator:1", numbers, told)

    def specimen(numbers: dict[str, float], **told: float) -> Left:
        return Left(name, "specimen:1", numbers, told)

    match name:
        case "delay_error":
            return actuator({"delay": 0.1 * size}, delay=0.1 * size)
        case "amplitude_dependent_delay":
            slope = 0.1 * size / x
            return actuator({"slope": slope}, slope=slope)
        case "second_order_lag":
            zeta = random.uniform(0.4, 1.2)
            return actuator({"lag": 0.1 * size, "lag_zeta": zeta}, time_constant=0.1 * size, damping_ratio=zeta)
        case "velocity_saturation":
            return actuator({"speed": (1 - size) * v}, velocity_limit=(1 - size) * v)
        case "force_compliance":
            return actuator({"flexibility": 0.02 * size * x / f}, flexibility=0.02 * size * x / f)
        case "dead_band":
            return actuator({"band": size * x}, half_width=size * x)
        case "backlash":
            return actuator({"play": 0.5 * size * x}, gap=size * x)
        case "stick_friction":
            lasting = random.uniform(0.01, 0.03)
            return actuator({"stick": size * x, "catching": lasting}, breakaway=size * x, catching=lasting)
        case "gain_error":
            return actuator({"gain": sign * size}, share=sign * size)
        case "valve_flow":
            return actuator({"stall": f / size}, inverse_stall_force=size / f)
        case "supply_saturation":
            sustained, emptying = SUSTAINED * v, size / seen["drawn"]
            return actuator({"sustained": sustained, "emptying": emptying}, velocity=sustained, emptying=emptying)
        case "uneven_speed":
            return actuator({"uneven": 3 * size})
        case "rate_dependent_gain":
            return actuator({"rate_gain": size / v})
        case "hysteretic_position":
            return actuator({"hysteresis": size * x, "hysteresis_width": x * random.uniform(0.1, 0.4)})
        case "wandering_speed":
            return actuator({"wander": 2 * size, "wander_rate": random.uniform(2.0, 5.0) / time})
        case "coulomb_friction":
            return specimen({"friction": size * f, "presliding": x * random.uniform(0.003, 0.02)}, friction=size * f)
        case "stribeck_friction":
            friction, more, slow = size * f, random.uniform(1.5, 3.0), v * random.uniform(0.03, 0.15)
            numbers = {"friction": friction, "presliding": 0.005 * x, "static": more * friction, "stribeck": slow}
            return specimen(numbers, friction=friction, breakaway=(more - 1) * friction, stribeck_velocity=slow)
        case "viscous_heating":
            return specimen({"fade": size / seen["energy"]}, fade=size / seen["energy"])
        case "parallel_stiffness":
            return specimen({"spring": sign * size * f / x}, stiffness=sign * size * f / x)
        case "cubic_stiffness":
            return specimen({"cubic": sign * size * f / x**3}, stiffness=sign * size * f / x**3)
        case "asymmetry":
            return specimen({"asymmetry": sign * size}, share=sign * size)
        case "velocity_exponent":
            return specimen({"exponent": sign * size, "reference": 0.5 * v}, exponent=sign * size)
        case "bouc_wen_hysteresis":
            x_y, n, eta = x * random.uniform(0.03, 0.15), random.uniform(1, 3), random.uniform(0.5, 0.8)
            numbers = {"strength": size * f, "x_y": x_y, "sharpness": n, "fullness": eta}
            return specimen(numbers, strength=size * f, yield_displacement=x_y, exponent=n, fullness=eta)
        case "pinching":
            width = x * random.uniform(0.1, 0.35)
            return specimen({"depth": size, "width": width}, depth=size, width=width)
        case "strength_drop":
            moment = time * random.uniform(0.3, 0.8)
            return specimen({"drop": size, "drop_time": moment}, share=size, time=moment)
        case _:
            kind = name.removeprefix("sensor_")
            acts, parameters = reading(random, kind, size, x, time)
            return Left(kind, "sensor:x_meas.1", {}, parameters, acts)
