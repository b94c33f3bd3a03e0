"""Cases of the closed loop, in which adaptive compensation masks the delay."""

from __future__ import annotations

import math

import numpy as np

from tests.proof.generator.case import Case, Recorded
from tests.proof.generator.ground import shaking
from tests.proof.generator.motion import Array
from tests.proof.generator.noise import Colour
from tests.proof.generator.rig import closed, driven
from tests.proof.generator.rig_bench import SPEED, TOLERANCE, Bench, coloured, seen_of, sized_effect, truth_of
from tests.proof.generator.rig_effects import ACTUATOR, OUTSIDE, Left
from tests.proof.generator.sizing import Absorbed
from tests.proof.generator.structure import Building

LARGEST = 0.3  # m, of a command
WITHIN = 0.8  # of the actuator's speed: a loop that takes more is on its way out


class Unstable(ArithmeticError):
    """The loop is unstable; a laboratory would not run it."""


def hybrid_case(seed: int, level: str, names: list[str], wanted: float, law: str, second: bool) -> Case:
    """A case of the closed loop with adaptive compensation; where a loop is unstable, another loop is drawn."""
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
        history: Array = closed(
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
        return history

    plain = looped(0, [], False)
    fastest = float(np.max(np.abs(np.diff(plain[:, 4])))) / step
    if not np.isfinite(plain).all() or np.max(np.abs(plain[:, 0])) > LARGEST or fastest > WITHIN * SPEED:
        raise Unstable
    seen = seen_of(plain[:, 4], plain[:, 5], step)
    on_actuator = bool(names) and (names[0] in ACTUATOR or names[0] in OUTSIDE)
    force_noise = coloured(random, "plain", plain[:, 5], step)
    displacement_noise = Colour(float(random.uniform(3e-6, 1.5e-5)), step, 1e4, 0.0)
    for place in range(2):
        f_noise[place][:] = force_noise.drawn(random, len(f_noise[place]))
        x_noise[place][:] = displacement_noise.drawn(random, len(x_noise[place]))
    noise = displacement_noise if on_actuator else force_noise
    sent = plain[:, 1]

    def alone(lefts: list[Left], numbers: Array | None = None) -> list[Array]:
        """The output of the component for its recorded input, so that lambda refers to the component and not to the loop."""
        return [driven(bench.rig(lefts) if numbers is None else numbers, sent, step)[0 if on_actuator else 1]]

    part, moved = ("actuator", bench.actuator) if on_actuator else ("specimen", bench.specimen)

    def off(numbers: dict[str, float]) -> list[Array]:
        return alone([], bench.rig([], numbers, None) if part == "actuator" else bench.rig([], None, numbers))

    absorbed = Absorbed(off, dict(moved), [noise], [TOLERANCE] * len(moved) if on_actuator else ())
    lefts = [sized_effect(absorbed, alone, seed, name, wanted, seen) for name in names]
    strength = absorbed.weakest(alone, lefts)
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
    truth = truth_of("hybrid", bench, lefts, names, strength, noise, "x_meas.1" if on_actuator else "f_meas.1")
    return Case(plan, recordings[0], recordings[1], truth)


def _ground(bench: Bench, long: float, factor: float) -> Array:
    motion = shaking(bench.random, factor * bench.small * float(bench.random.uniform(1.5, 3.5)), bench.duration)
    return motion.sample(np.arange(int(bench.duration / long)) * long)
