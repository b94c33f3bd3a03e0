"""Cases of a structure alone: ground acceleration or a release, measured floors."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from tests.proof.generator.case import Case, Recorded, Truth
from tests.proof.generator.ground import Ground, shaking
from tests.proof.generator.motion import Array, Motion
from tests.proof.generator.noise import Colour
from tests.proof.generator.sizing import Absorbed, sized
from tests.proof.generator.structure import Building, Whole, off, response
from tests.proof.generator.structure_effects import OUTSIDE, Left, effect

STIFFNESS, DAMPING = 0.02, 0.1  # how far a plan is off
TOLERANCE = 0.03  # of what a plan's numbers may be off, for lambda


Excited = tuple[Motion | None, tuple[Array, Array] | None]  # by the ground, or let go with displacements and velocities


class Site:
    """The structure of one case, which both recordings share."""

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
        """The output with the stiffness of each storey and the damping multiplied by factors near 1."""
        stiffness = {int(name): share - 1 for name, share in shares.items() if name != "damping"}
        return outputs([Left("", "", {}, whole=Whole(stiffness=stiffness, damping=shares["damping"] - 1))])

    storeys = [str(storey) for storey in range(1, len(x) + 1)]
    tolerances = dict.fromkeys(storeys, TOLERANCE) | {"damping": 0.2}
    absorbed = Absorbed(off_by, dict.fromkeys(tolerances, 1.0), noises, list(tolerances.values()))
    lefts = []
    for name in names:
        start = 0.3 if name == "yielding" else 0.05

        def strength_of(size: float, name: str = name) -> float:
            return absorbed.strength(outputs([effect(seed + 1, name, size, seen)]))

        size = sized(strength_of, wanted, start, 0.9)
        lefts.append(effect(seed + 1, name, size, seen))
    strength = absorbed.weakest(outputs, lefts)
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
    """The measured channels: all floors, or the top floor alone at the level `missing`."""
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
        assert start is not None
        return {**made, "start": {"displacement": [float(one) for one in start[0]]}}
    samples = motion.sample(np.arange(0.0, site.duration, 0.02))
    return {**made, "motion": {"kind": "inline", "dt": 0.02, "acceleration": [float(one) for one in samples]}}
