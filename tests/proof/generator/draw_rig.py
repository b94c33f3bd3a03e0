"""Cases of an actuator, and of an actuator with its specimen but without the displacement between them."""

from __future__ import annotations

import numpy as np

from tests.proof.generator.case import Case, Recorded
from tests.proof.generator.motion import Array, random_motion
from tests.proof.generator.noise import Colour
from tests.proof.generator.rig import driven
from tests.proof.generator.rig_bench import TOLERANCE, Bench, coloured, seen_of, sized_effect, truth_of
from tests.proof.generator.rig_effects import Left
from tests.proof.generator.sizing import Absorbed

PARTS = ("actuator", "specimen")


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
    seen = seen_of(x, f, step)
    if test == "actuator":
        share = 10 if level == "noise" else 1
        noise = Colour(share * float(random.uniform(5e-6, 2e-5)), step, 1e4, 0.0)
    else:
        noise = coloured(random, level, f, step)
    moved = {f"actuator.{key}": value for key, value in bench.actuator.items()}
    tolerances = [TOLERANCE] * len(moved)
    if test == "specimen":
        moved |= {f"specimen.{key}": value for key, value in bench.specimen.items()}
        tolerances += [1.0] * len(bench.specimen)

    def off(numbers: dict[str, float]) -> list[Array]:
        parts = {part: {key.partition(".")[2]: v for key, v in numbers.items() if key.startswith(part)} for part in PARTS}
        return out([], bench.rig([], parts["actuator"], parts["specimen"] or bench.specimen))

    absorbed = Absorbed(off, moved, [noise], tolerances)
    lefts = [sized_effect(absorbed, lambda lefts: out(lefts), seed, name, wanted, seen) for name in names]
    strength = absorbed.weakest(out, lefts)
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
    return Case(plan, recordings[0], recordings[1], truth_of(test, bench, lefts, names, strength, noise, output))


def _command(bench: Bench, factor: float) -> Array:
    kind = str(bench.random.choice(["earthquake", "noise", "sweep", "cycles"]))
    motion = random_motion(bench.random, kind, factor * bench.peak, bench.duration)
    return motion.sample(np.arange(int(bench.duration * bench.rate)) / bench.rate)
