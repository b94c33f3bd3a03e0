"""Cases of a specimen alone: prescribed displacement, measured force."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np

from tests.proof.generator import outside, specimen
from tests.proof.generator.case import Case, Recorded, Truth
from tests.proof.generator.laws import LAWS, Law
from tests.proof.generator.motion import STEP, Array, Motion, random_motion
from tests.proof.generator.noise import SMOOTHED, Colour
from tests.proof.generator.readings import Reading
from tests.proof.generator.sizing import Absorbed, sized
from tests.proof.generator.specimen_effects import CURRENT, FIRST, IDS, Left, effect, most


def baseline(random: np.random.Generator, kind: str) -> dict[str, float]:
    """A specimen of a size that laboratories test."""

    def around(value: float, spread: float = 2.0) -> float:
        return float(value * spread ** random.uniform(-1, 1))

    match kind:
        case "linear":
            return {"stiffness": around(1.5e6), "damping": around(5e5)}
        case "mr_damper":
            return {
                "yield_force": around(1.38e5, 1.5),
                "rate_coefficient": around(1.6e5, 1.5),
                "rate_exponent": around(0.46, 1.2),
                "stiffness": around(1e8, 1.5),
                "damping": around(1e7, 1.5),
            }
        case "hyperbolic_tangent":
            return {
                "yield_force": around(1.5e5),
                "velocity_scale": around(0.02),
                "displacement_scale": around(0.05, 1.5),
                "stiffness": around(3e5),
                "damping": around(1e5),
            }
        case _:
            return {"slip_force": around(1e5), "stiffness": around(5e7)}


def scales(motion: Motion, force: Array, time: Array) -> dict[str, float]:
    x, v, a = (motion.sample(time, order) for order in range(3))
    step = time[1] - time[0]
    return {
        "x": float(np.max(np.abs(x))),
        "v": float(np.max(np.abs(v))),
        "a": float(np.max(np.abs(a))),
        "f": float(np.max(np.abs(force))),
        "energy": float(np.sum(np.abs(force * v)) * step),
        "travel": float(np.sum(np.abs(v)) * step),
        "time": float(time[-1]),
    }


def switched(random: np.random.Generator, duration: float) -> Callable[[float], float]:
    """A current between 0.5 and 2.5 A, switched within 20 ms every few seconds."""
    moments = np.cumsum(random.uniform(1.0, 3.0, int(duration) + 2))
    levels = random.uniform(0.5, 2.5, len(moments) + 1)
    time = np.concatenate([[0.0], np.column_stack([moments, moments + 0.02]).ravel()])
    values = np.concatenate([[levels[0]], np.column_stack([levels[:-1], levels[1:]]).ravel()])
    return lambda t: float(np.interp(t, time, values))


def warming(random: np.random.Generator, duration: float) -> Callable[[float], float]:
    """A temperature (K) that rises and falls between 10 and 45 degrees Celsius over some seconds, as in a climate chamber."""
    moments = np.cumsum(random.uniform(3.0, 6.0, int(duration / 3) + 2))
    values = 273.15 + random.uniform(10.0, 45.0, len(moments))
    return lambda t: float(np.interp(t, moments - moments[0], values))


class Bench:
    """The rig of one case, which both recordings share."""

    def __init__(self, seed: int, level: str, law: str, names: list[str]) -> None:
        self.random = random = np.random.default_rng(seed)
        self.seed, self.level, self.kind, self.names = seed, level, law, names
        self.rate = float(random.choice([256, 512, 1024]))
        self.numbers = baseline(random, law)
        self.peak = float(np.exp(random.uniform(np.log(0.015), np.log(0.08)))) * (0.2 if level == "small" else 1.0)
        self.motion = self.moved(1.0)
        self.current = switched(random, 45.0) if CURRENT & set(names) else specimen.steady
        warms = "strength_against_temperature" in names
        self.temperature = warming(random, 45.0) if warms else specimen.mild

    def moved(self, factor: float) -> Motion:
        kind = str(self.random.choice(["earthquake", "noise", "sweep", "cycles"], p=[0.4, 0.3, 0.15, 0.15]))
        return random_motion(self.random, kind, factor * self.peak, float(self.random.uniform(15, 35)))

    def time(self, motion: Motion) -> Array:
        return np.arange(int(motion.duration * self.rate)) / self.rate

    def law(self, numbers: dict[str, float]) -> Law:
        law: Law = LAWS[self.kind](**numbers)
        return law

    def force(self, lefts: list[Left], motion: Motion, numbers: dict[str, float] | None = None) -> Array:
        acting = [one.acts for one in lefts if not isinstance(one.acts, Reading)]
        time = self.time(motion)
        found = specimen.force(self.law(numbers or self.numbers), acting, motion, time, self.current, self.temperature)
        for one in lefts:
            if isinstance(one.acts, Reading):
                found = one.acts.read(found, time)
        return found


def specimen_case(seed: int, level: str, law: str, names: list[str], wanted: float) -> Case:
    """A case of a specimen. `names` are effects of the library or of outside.NAMES; `wanted` is the lambda of each effect."""
    bench = Bench(seed, level, law, names)
    random = bench.random
    plain = bench.force([], bench.motion)
    scale = scales(bench.motion, plain, bench.time(bench.motion))
    moments = bench.time(bench.motion).tolist()
    scale["current"] = max(bench.current(t) for t in moments)
    scale["temperature"] = float(np.mean([bench.temperature(t) for t in moments]))
    share = np.exp(random.uniform(np.log(0.02), np.log(0.06))) if level == "noise" else random.uniform(0.004, 0.02)
    corner, flicker = float(np.exp(random.uniform(np.log(5.0), np.log(60.0)))), float(random.uniform(0, 0.25))
    displacement_noise = float(random.uniform(3e-6, 2e-5))
    taken = displacement_noise * stiffness_against_noise(bench)
    noise = Colour(float(share * np.std(plain)), 1 / bench.rate, corner, flicker, taken)
    absorbed = Absorbed(lambda numbers: [bench.force([], bench.motion, numbers)], bench.numbers, [noise])

    def left(name: str, size: float) -> Left:
        if name in outside.NAMES:
            acts = outside.drawn(np.random.default_rng(seed + 1), name, size, scale)
            return Left(name, "specimen:1", acts, {"size": size}, "outside")
        return effect(seed + 1 + IDS.index(name) if name in IDS else seed, name, size, scale)

    lefts = []
    for name in names:

        def strength_of(size: float, name: str = name) -> float:
            try:
                return absorbed.strength([bench.force([left(name, size)], bench.motion)])
            except ArithmeticError:  # too stiff to solve
                return np.inf

        size = sized(strength_of, wanted, FIRST, most(name))
        lefts.append(left(name, size))
    strength = absorbed.weakest(lambda lefts: [bench.force(lefts, bench.motion)], lefts)
    other = bench.moved(float(random.uniform(0.6, 1.4)))
    fitting, heldout = (recorded(bench, lefts, one, noise, displacement_noise) for one in (bench.motion, other))
    planned = {name: value * (1 + random.uniform(-0.04, 0.04)) for name, value in bench.numbers.items()}
    hidden = next((one.id for one in lefts if one.form == "outside"), None)
    told = [] if hidden else [one.told() for one in lefts]
    about = {"law": law, "rate": bench.rate, "displacement_noise": displacement_noise, "force_noise_share": float(share)}
    truth = Truth("specimen", level, seed, told, hidden, strength, bench.numbers, asdict(noise), "f_meas.1", about)
    return Case(plan(law, planned, bench), fitting, heldout, truth)


def stiffness_against_noise(bench: Bench) -> float:
    """Ratio (N/m) of the RMS force to the RMS of a small random displacement below SMOOTHED."""
    motion, time = bench.motion, bench.time(bench.motion)
    knots = np.arange(0.0, motion.duration + STEP / 2, STEP)
    white = np.fft.rfft(np.random.default_rng(bench.seed).standard_normal(len(knots)))
    white[np.fft.rfftfreq(len(knots), STEP) > SMOOTHED] = 0.0
    moved = Motion(motion.sample(knots) + 1e-6 * np.fft.irfft(white, len(knots)))
    added = bench.force([], moved) - bench.force([], motion)
    return float(np.std(added) / np.std(moved.sample(time) - motion.sample(time)))


def recorded(bench: Bench, lefts: list[Left], motion: Motion, noise: Colour, displacement_noise: float) -> Recorded:
    time, random = bench.time(motion), bench.random
    x, f = motion.sample(time), bench.force(lefts, motion)
    shown: dict[str, Array] = {
        "x_meas.1": x + displacement_noise * random.standard_normal(len(x)),
        "f_meas.1": f + noise.drawn(random, len(f)),
    }
    quiet: dict[str, Array] = {"x_meas.1": x, "f_meas.1": f}
    if bench.current is not specimen.steady:
        shown["current.1"] = quiet["current.1"] = np.array([bench.current(t) for t in time.tolist()])
    if bench.temperature is not specimen.mild:
        shown["temperature.1"] = quiet["temperature.1"] = np.array([bench.temperature(t) for t in time.tolist()])
    return Recorded(1 / bench.rate, shown, quiet)


def plan(law: str, planned: dict[str, float], bench: Bench) -> dict[str, Any]:
    """The plan of the laboratory. Its drive has the same kind of motion as the recording, but not the same samples."""
    speed = float(np.max(np.abs(bench.motion.sample(bench.time(bench.motion), 1))))
    shape = {"kind": "band_noise", "low_frequency": 0.2, "high_frequency": 2.0, "duration": 20.0, "seed": 1}
    return {
        "schema": "rths-plan/1",
        "name": f"Specimen {bench.seed}",
        "test": "specimen",
        "controller_rate": bench.rate,
        "drive": {"amplitude": float(min(bench.peak, 0.02)), "shape": shape},
        "stations": [
            {
                "name": "Specimen",
                "compensator": {"kind": "none"},
                "actuator": {"kind": "first_order_delay", "alpha": 1.0, "velocity_limit": max(1.0, math.ceil(2 * speed))},
                "specimen": {"kind": law, **{name: float(value) for name, value in planned.items()}},
            }
        ],
    }
