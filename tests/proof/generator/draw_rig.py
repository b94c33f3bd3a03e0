"""Cases with an actuator: alone, with its specimen but without the displacement between them, and in the closed loop."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from tests.proof.generator.case import Case, Recorded, Truth
from tests.proof.generator.draw_structure import shaking
from tests.proof.generator.motion import Array, random_motion
from tests.proof.generator.noise import Colour
from tests.proof.generator.readings import Reading, reading
from tests.proof.generator.rig import LINEAR, SLIDER_MAXWELL, TANGENT, closed, driven, rig
from tests.proof.generator.sizing import Absorbed, sized
from tests.proof.generator.structure import Building

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
)
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
LAWS = {"linear": LINEAR, "mr_damper": SLIDER_MAXWELL, "hyperbolic_tangent": TANGENT}
OWN = {"linear": {"parallel_stiffness"}, "mr_damper": set(), "hyperbolic_tangent": {"parallel_stiffness"}}
LARGEST = 0.3  # m, of a command
TOLERANCE = 0.05  # of the numbers of an actuator
PARTS = ("actuator", "specimen")


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
        self.specimen = _specimen(random, law)

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
            "actuator": {"kind": kind, "velocity_limit": 2.0, **actuator},
            "specimen": {"kind": self.law, **specimen},
            "limits": {"displacement": 1.0, "velocity": 2.0, "force": 1e8},
        }


def _second_order(random: np.random.Generator) -> dict[str, float]:
    frequency, damping = float(random.uniform(8, 25)), float(random.uniform(0.6, 1.1))
    return {"frequency": frequency, "damping_ratio": damping, "dead_time": float(random.uniform(0.003, 0.012))}


def _specimen(random: np.random.Generator, law: str) -> dict[str, float]:
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
    return {"speed": min([2.0, *(one.numbers["speed"] for one in lefts if "speed" in one.numbers)])}


def _noise(random: np.random.Generator, level: str, signal: Array, step: float) -> Colour:
    share = np.exp(random.uniform(np.log(0.02), np.log(0.06))) if level == "noise" else random.uniform(0.004, 0.02)
    corner = float(np.exp(random.uniform(np.log(5.0), np.log(60.0))))
    return Colour(float(share * np.std(signal)), step, corner, float(random.uniform(0, 0.25)))


def _seen(x: Array, f: Array, step: float) -> dict[str, float]:
    v = np.gradient(x, step)
    peaks = {key: float(np.max(np.abs(one))) for key, one in (("x", x), ("v", v), ("f", f))}
    return {**peaks, "energy": float(np.sum(np.abs(f * v)) * step), "time": len(x) * step}


def actuator_case(seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    """Command -> displacement, against the force of a specimen."""
    return _open_case("actuator", seed, level, names, wanted, law, second)


def chain_case(seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    """Command -> force, where the displacement was not measured."""
    return _open_case("specimen", seed, level, names, wanted, law, second)


def _open_case(test: str, seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    bench = Bench(seed, level, law, second)
    random, step = bench.random, bench.step
    commands = [_command(bench, factor) for factor in (1.0, float(random.uniform(0.6, 1.3)))]
    output = "x_meas.1" if test == "actuator" else "f_meas.1"

    def both(lefts: list[Left], command: Array, numbers: Array | None = None) -> tuple[Array, Array]:
        x, f = driven(bench.rig(lefts) if numbers is None else numbers, command, step)
        for one in lefts:
            x = one.reading.read(x, np.arange(len(x)) * step) if one.reading else x
        return x, f

    def out(lefts: list[Left], numbers: Array | None = None) -> list[Array]:
        return [both(lefts, commands[0], numbers)[0 if test == "actuator" else 1]]

    x, f = both([], commands[0])
    seen = _seen(x, f, step)
    if test == "actuator":
        share = 10 if level == "noise" else 1
        noise = Colour(share * float(random.uniform(5e-6, 2e-5)), step, 1e4, 0.0)
    else:
        noise = _noise(random, level, f, step)
    moved = {f"actuator.{key}": value for key, value in bench.actuator.items()}
    tolerances = [TOLERANCE] * len(moved)
    if test == "specimen":
        moved |= {f"specimen.{key}": value for key, value in bench.specimen.items()}
        tolerances += [1.0] * len(bench.specimen)

    def off(numbers: dict[str, float]) -> list[Array]:
        parts = {part: {key.partition(".")[2]: v for key, v in numbers.items() if key.startswith(part)} for part in PARTS}
        return out([], bench.rig([], parts["actuator"], parts["specimen"] or bench.specimen))

    absorbed = Absorbed(off, moved, [noise], tolerances)
    lefts = [_sized(absorbed, lambda lefts: out(lefts), seed, name, wanted, seen) for name in names]
    strength = absorbed.strength(out(lefts)) if lefts else None
    keys = ["x_comp.1", "f_meas.1"] if test == "specimen" else ["x_comp.1", "x_meas.1", "f_meas.1"]
    keys = [key for key in keys if not (level == "missing" and test == "actuator" and key == "f_meas.1")]
    recordings = []
    for command in commands:
        x, f = both(lefts, command)
        quiet = {"x_comp.1": command, "x_meas.1": x, "f_meas.1": f}
        force_noise = noise if test == "specimen" else Colour(0.01 * float(np.std(f)), step, 20.0, 0.1)
        added = {
            "x_meas.1": noise.drawn(random, len(x)) if test == "actuator" else 0.0,
            "f_meas.1": force_noise.drawn(random, len(f)),
        }
        recordings.append(Recorded(step, {key: quiet[key] + added.get(key, 0.0) for key in keys}, quiet))
    shape = {"kind": "band_noise", "low_frequency": 0.2, "high_frequency": 2.0, "duration": 20.0, "seed": 1}
    plan = {
        "schema": "rths-plan/1",
        "name": f"Rig {seed}",
        "test": test,
        "controller_rate": bench.rate,
        "drive": {"amplitude": float(min(bench.peak, 0.02)), "shape": shape},
        "stations": [bench.station({"kind": "none"})],
    }
    return Case(plan, recordings[0], recordings[1], _truth(test, bench, lefts, names, strength, noise, output))


def _sized(absorbed: Absorbed, out: Any, seed: int, name: str, wanted: float, seen: dict[str, float]) -> Left:
    def strength_of(size: float) -> float:
        return absorbed.strength(out([effect(seed + 1, name, size, seen)]))

    first, most = {"velocity_saturation": (0.3, 0.9), "force_compliance": (0.02, 0.2)}.get(name, (0.03, 0.6))
    return effect(seed + 1, name, sized(strength_of, wanted, first, most), seen)


def _command(bench: Bench, factor: float) -> Array:
    kind = str(bench.random.choice(["earthquake", "noise", "sweep", "cycles"]))
    motion = random_motion(bench.random, kind, factor * bench.peak, bench.duration)
    return motion.sample(np.arange(int(bench.duration * bench.rate)) / bench.rate)


def _truth(
    kind: str, bench: Bench, lefts: list[Left], names: list[str], strength: float | None, noise: Colour, output: str
) -> Truth:
    hidden = names[0] if names and names[0] in OUTSIDE else None
    told = [] if hidden else [one.told() for one in lefts]
    component = lefts[0].component if lefts else ""
    about = {"component": component, "law": bench.law, "rate": bench.rate, "actuator": sorted(bench.actuator)[0]}
    true = {"actuator": bench.actuator, "specimen": bench.specimen}
    return Truth(kind, bench.level, bench.seed, told, hidden, strength, true, asdict(noise), output, about)


class Unstable(ArithmeticError):
    """A loop that runs away: its laboratory would not run it either."""


def hybrid_case(seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    """The closed loop, its delay compensated adaptively; another loop is drawn where one is unstable."""
    for other in range(20):
        try:
            return _hybrid_case(seed + other, level, names, wanted, law, second)
        except Unstable:
            continue
    raise Unstable(f"no stable loop near seed {seed}")


def _hybrid_case(seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    bench = Bench(seed, level, law, second)
    random, step = bench.random, bench.step
    n = int(random.choice([4, 8]))
    delay = bench.actuator.get("alpha") or 1 + bench.rate * (
        bench.actuator["dead_time"] + bench.actuator["damping_ratio"] / (math.pi * bench.actuator["frequency"])
    )
    gains = [0.4e6, 0.04e6]
    alpha = max(1.0, delay * float(random.uniform(0.9, 1.1)))
    storeys = int(random.integers(1, 3))
    building = Building(
        np.full(storeys, float(random.uniform(8e4, 1.5e5))), np.full(storeys, float(random.uniform(4e6, 9e6))), 0.03
    )
    mass, damping, stiffness = building.matrices()
    equivalent = float(random.uniform(1.5e5, 3e5))
    drift = np.zeros(storeys)
    drift[0] = 1.0
    long = n * step
    effective = mass + long / 2 * (damping + equivalent * np.outer(drift, drift)) + long**2 / 4 * stiffness
    grounds = [_ground(bench, long, factor) for factor in (1.0, float(random.uniform(0.6, 1.2)))]
    f_noise = [np.zeros(n * (len(one) - 1)) for one in grounds]
    x_noise = [1.0 * one for one in f_noise]

    def looped(place: int, lefts: list[Left], noisy: bool) -> Array:
        own = 1.0 if noisy else 0.0
        values = np.array([alpha, *gains])
        numbers = bench.rig(lefts)
        return closed(
            numbers,
            mass,
            damping,
            stiffness,
            effective,
            drift,
            grounds[place],
            own * x_noise[place],
            own * f_noise[place],
            n,
            step,
            values,
        )

    plain = looped(0, [], False)
    if not np.isfinite(plain).all() or np.max(np.abs(plain[:, 0])) > LARGEST:
        raise Unstable
    seen = _seen(plain[:, 4], plain[:, 5], step)
    on_actuator = bool(names) and (names[0] in ACTUATOR or names[0] in OUTSIDE)
    force_noise = _noise(random, "plain", plain[:, 5], step)
    displacement_noise = Colour(float(random.uniform(3e-6, 1.5e-5)), step, 1e4, 0.0)
    for place in range(2):
        f_noise[place][:] = force_noise.drawn(random, len(f_noise[place]))
        x_noise[place][:] = displacement_noise.drawn(random, len(x_noise[place]))
    noise = displacement_noise if on_actuator else force_noise
    sent = plain[:, 1]

    def alone(lefts: list[Left], numbers: Array | None = None) -> list[Array]:
        """The component's output on what went into it, so that lambda is of the component and not of the loop."""
        return [driven(bench.rig(lefts) if numbers is None else numbers, sent, step)[0 if on_actuator else 1]]

    part, moved = ("actuator", bench.actuator) if on_actuator else ("specimen", bench.specimen)

    def off(numbers: dict[str, float]) -> list[Array]:
        return alone([], bench.rig([], numbers, None) if part == "actuator" else bench.rig([], None, numbers))

    absorbed = Absorbed(off, dict(moved), [noise], [TOLERANCE] * len(moved) if on_actuator else ())
    lefts = [_sized(absorbed, alone, seed, name, wanted, seen) for name in names]
    strength = absorbed.strength(alone(lefts)) if lefts else None
    recordings = []
    for place, ground in enumerate(grounds):
        found = looped(place, lefts, True)
        if not np.isfinite(found).all() or np.max(np.abs(found[:, 0])) > LARGEST:
            raise Unstable
        keys = ("x_cmd.1", "x_comp.1", "x_meas.1", "f_meas.1")
        shown = {key: found[:, column] for column, key in enumerate(keys)}
        share = np.tile(np.arange(1, n + 1) / n, len(ground) - 1)
        shown["ag"] = np.repeat(ground[:-1], n) + share * np.repeat(np.diff(ground), n)
        recordings.append(Recorded(step, shown, {"x_meas.1": found[:, 4], "f_meas.1": found[:, 5]}, start=step))
    station = bench.station({"kind": "aic", "alpha_es": alpha, "kp": gains[0], "ki": gains[1]}) | {
        "storey": 1,
        "equivalent_damping": equivalent,
    }
    plan = {
        "schema": "rths-plan/1",
        "name": f"Hybrid {seed}",
        "test": "hybrid",
        "controller_rate": bench.rate,
        "structure": {
            "kind": "shear_building",
            "storeys": [
                {"mass": float(m), "stiffness": float(k)} for m, k in zip(building.masses, building.stiffnesses, strict=True)
            ],
            "damping_ratio": building.ratio,
        },
        "integrator": {"kind": "cr", "dt": long, "substeps": n},
        "motion": {"kind": "inline", "dt": long, "acceleration": grounds[0].tolist()},
        "duration": float(long * (len(grounds[0]) - 1)),
        "stations": [station],
    }
    truth = _truth("hybrid", bench, lefts, names, strength, noise, "x_meas.1" if on_actuator else "f_meas.1")
    return Case(plan, recordings[0], recordings[1], truth)


def _ground(bench: Bench, long: float, factor: float) -> Array:
    motion = shaking(bench.random, factor * bench.small * float(bench.random.uniform(1.5, 3.5)), bench.duration)
    return motion.sample(np.arange(int(bench.duration / long)) * long)
