"""Cases of a structure alone: ground acceleration or a release, measured floors."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from tests.proof.generator import structure as physics
from tests.proof.generator.case import Case, Recorded, Truth
from tests.proof.generator.motion import STEP, Array, Motion, tapered
from tests.proof.generator.noise import Colour
from tests.proof.generator.sizing import Absorbed, sized
from tests.proof.generator.structure import Building, Element, Whole, off, response

STIFFNESS, DAMPING = 0.02, 0.1  # how far a plan is off
TOLERANCE = 0.03  # of what a plan's numbers may be off, for lambda
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
)
OUTSIDE = ("cubic_memory", "softening_by_travel", "cogging", "parametric_stiffness", "one_sided_cubic_damping")


Excited = tuple[Motion | None, tuple[Array, Array] | None]  # by the ground, or let go with displacements and velocities


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


class Ground:
    """A ground acceleration, with what errors make of it: (1 + e) a(t - T) through a first-order low-pass, + b + c t."""

    def __init__(self, motion: Motion | None, errors: dict[str, float]) -> None:
        self.scale, self.shift, self.offset, self.rate = (errors.get(key, 0.0) for key in ("scale", "shift", "offset", "rate"))
        self.motion = passed(motion, errors["low_pass"]) if motion and "low_pass" in errors else motion

    def __call__(self, time: Array) -> Array:
        drift = self.offset + self.rate * time
        if self.motion is None:
            return drift
        felt = self.motion.sample(np.clip(time - self.shift, 0.0, self.motion.duration))
        return np.asarray((1 + self.scale) * felt + drift)


def passed(motion: Motion, constant: float) -> Motion:
    """T y' + y = a, exact for a linear between quarter knots."""
    fine = np.arange(0.0, motion.duration + motion.step / 8, motion.step / 4)
    a, h = motion.sample(fine), motion.step / 4
    decay, out = math.exp(-h / constant), [0.0]
    share = constant / h * (1 - decay)
    for before, now in zip(a[:-1].tolist(), a[1:].tolist(), strict=True):
        out.append(decay * out[-1] + (share - decay) * before + (1 - share) * now)
    return Motion(np.array(out)[::4], motion.step)


def shaking(random: np.random.Generator, peak: float, duration: float) -> Motion:
    """An earthquake-like ground acceleration between 0.3 and 12 Hz."""
    time = np.arange(round(duration / STEP) + 1) * STEP
    tones = np.exp(random.uniform(np.log(0.3), np.log(12.0), 80))
    weight = 1 / (1 + (tones / random.uniform(1.5, 4.0)) ** 2)
    phases = random.uniform(0, 2 * np.pi, 80)
    wave = sum(w * np.sin(2 * np.pi * f * time + p) for w, f, p in zip(weight, tones, phases, strict=True))
    rise, fall = 0.15 * duration, 0.3 * duration
    wave = np.asarray(wave) * np.exp(-np.maximum(time - 2 * rise, 0.0) / fall) * tapered(time, duration)
    return Motion(peak * wave / np.max(np.abs(wave)))


class Site:
    """The structure of one case and what is the same in its recordings."""

    def __init__(self, seed: int, level: str, free: bool) -> None:
        self.random = random = np.random.default_rng(seed)
        self.seed, self.level, self.free = seed, level, free
        count = int(random.integers(2, 4))
        masses = np.sort(random.uniform(2e4, 6e4, count))[::-1]
        frequency = random.uniform(0.8, 2.0)
        shape = np.sort(random.uniform(0.7, 1.0, count))[::-1]
        unit = Building(masses, shape, 0.0)
        mass, _, stiffness = unit.matrices()
        first = float(np.min(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real))
        self.building = Building(masses, shape * (2 * np.pi * frequency) ** 2 / first, float(random.uniform(0.01, 0.03)))
        self.frequency = frequency
        self.rate = float(random.choice([128, 256, 512]))
        self.peak = float(random.uniform(1.0, 3.5)) * (0.2 if level == "small" else 1.0)
        self.duration = float(random.uniform(16, 30))

    def excited(self, factor: float) -> Excited:
        if not self.free:
            return shaking(self.random, factor * self.peak, self.duration), None
        shape = np.linspace(0.5, 1.0, len(self.building.masses))
        return None, (0.02 * factor * self.peak * shape, np.zeros(len(shape)))

    def time(self) -> Array:
        return np.arange(int(self.duration * self.rate)) / self.rate

    def floors(self, lefts: list[Left], excited: Excited, building: Building | None = None) -> tuple[Array, Array]:
        motion, start = excited
        whole = Whole()
        for one in lefts:
            whole = whole.joined(one.whole) if one.whole else whole
        errors = {key: value for one in lefts for key, value in (one.ground or {}).items()}
        elements = [element for one in lefts for element in one.elements]
        return response(building or self.building, whole, elements, Ground(motion, errors), self.time(), start)


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
        case "softening_by_travel":
            return Element(storey, physics.TIRED, (size, d * random.uniform(5, 15)))
        case "cogging":
            return Element(storey, physics.COGGING, (size * f, d * random.uniform(0.15, 0.4)))
        case "parametric_stiffness":
            return Element(storey, physics.PARAMETRIC, (size, random.uniform(2.0, 5.0) / lasting))
        case _:
            return Element(storey, physics.ONE_SIDED, (size * f / v**3,))


def structure_case(seed: int, level: str, names: list[str], wanted: float, free: bool) -> Case:
    site = Site(seed, level, free)
    random, building = site.random, site.building
    excited = site.excited(1.0)
    x, a = site.floors([], excited)
    drift = building.drifts @ x
    seen = {
        "d": np.max(np.abs(drift), axis=1).tolist(),
        "v": np.max(np.abs(np.gradient(drift, 1 / site.rate, axis=1)), axis=1).tolist(),
        "k": building.stiffnesses.tolist(),
        "a": site.peak,
        "time": site.duration,
    }
    share = float(np.exp(random.uniform(np.log(0.02), np.log(0.06))) if level == "noise" else random.uniform(0.004, 0.02))
    corner, flicker = float(np.exp(random.uniform(np.log(5.0), np.log(40.0)))), float(random.uniform(0, 0.2))
    keys = channels(random, len(x), level)
    place = {key: (x if key.startswith("x") else a)[int(key[-1]) - 1] for key in keys}
    noises = [Colour(share * float(np.std(one)), 1 / site.rate, corner, flicker) for one in place.values()]

    def outputs(lefts: list[Left]) -> list[Array]:
        x, a = site.floors(lefts, excited)
        return [(x if key.startswith("x") else a)[int(key[-1]) - 1] for key in keys]

    def off_by(shares: dict[str, float]) -> list[Array]:
        """Shares about 1 of each storey's stiffness and of the damping."""
        stiffness = {int(name): share - 1 for name, share in shares.items() if name != "damping"}
        return outputs([Left("", "", {}, whole=Whole(stiffness=stiffness, damping=shares["damping"] - 1))])

    storeys = [str(storey) for storey in range(1, len(x) + 1)]
    tolerances = dict.fromkeys(storeys, TOLERANCE) | {"damping": 0.2}
    absorbed = Absorbed(off_by, dict.fromkeys(tolerances, 1.0), noises, list(tolerances.values()))
    lefts = []
    for name in names:
        start = 0.3 if name == "yielding" else 0.05
        size = sized(
            lambda size, name=name: absorbed.strength(outputs([effect(seed + 1, name, size, seen)])), wanted, start, 0.9
        )
        lefts.append(effect(seed + 1, name, size, seen))
    strength = absorbed.strength(outputs(lefts)) if lefts else None
    other = site.excited(float(random.uniform(0.6, 1.3)))
    fitting, heldout = (recorded(site, lefts, one, keys, noises) for one in (excited, other))
    planned = off(building, random.uniform(-STIFFNESS, STIFFNESS, len(x)), float(random.uniform(-DAMPING, DAMPING)))
    hidden = names[0] if names and names[0] in OUTSIDE else None
    told = [] if hidden else [one.told() for one in lefts]
    component = lefts[0].component if lefts else "structure"
    about = {"component": component, "rate": site.rate, "channels": keys, "noise_share": share, "free": free}
    true = {"masses": building.masses.tolist(), "stiffnesses": building.stiffnesses.tolist(), "ratio": building.ratio}
    truth = Truth("structure", level, seed, told, hidden, strength, true, asdict(noises[0]), keys[0], about)
    return Case(plan(site, planned, excited), fitting, heldout, truth)


def channels(random: np.random.Generator, floors: int, level: str) -> list[str]:
    """What is measured: every floor, or with a channel missing the top one alone."""
    kind = str(random.choice(["x_floor", "a_floor"], p=[0.7, 0.3]))
    return [f"{kind}.{floor}" for floor in range(floors if level == "missing" else 1, floors + 1)]


def recorded(site: Site, lefts: list[Left], excited: Excited, keys: list[str], noises: list[Colour]) -> Recorded:
    x, a = site.floors(lefts, excited)
    quiet = {key: (x if key.startswith("x") else a)[int(key[-1]) - 1] for key in keys}
    shown = {key: quiet[key] + noise.drawn(site.random, x.shape[1]) for key, noise in zip(keys, noises, strict=True)}
    if excited[0] is not None:
        ground = excited[0].sample(site.time())
        quiet["ag"] = ground
        shown["ag"] = ground + 2e-4 * site.peak * site.random.standard_normal(len(ground))
    return Recorded(1 / site.rate, shown, quiet)


def plan(site: Site, planned: Building, excited: Excited) -> dict[str, Any]:
    if site.random.random() < 0.5:
        mass, damping, stiffness = (matrix.tolist() for matrix in planned.matrices())
        structure: dict[str, Any] = {"kind": "matrices", "mass": mass, "stiffness": stiffness, "damping": damping}
    else:
        storeys = [{"mass": float(m), "stiffness": float(k)} for m, k in zip(planned.masses, planned.stiffnesses, strict=True)]
        structure = {"kind": "shear_building", "storeys": storeys, "damping_ratio": float(planned.ratio)}
    made = {
        "schema": "rths-plan/1",
        "name": f"Structure {site.seed}",
        "test": "structure",
        "controller_rate": site.rate,
        "duration": float(site.duration),
        "structure": structure,
        "integrator": {"kind": "cr", "dt": 1 / site.rate, "substeps": 1},
    }
    motion, start = excited
    if motion is None:
        return {**made, "start": {"displacement": [float(one) for one in start[0]]}}
    samples = motion.sample(np.arange(0.0, site.duration, 0.02))
    return {**made, "motion": {"kind": "inline", "dt": 0.02, "acceleration": [float(one) for one in samples]}}
