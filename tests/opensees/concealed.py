"""Recordings that conceal a material law of OpenSees: a specimen or a storey, planned as linear with numbers that are off."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tests.opensees.laws import SPECIMENS, STRUCTURES, Law, Scale, critical, dashpot, light_damping
from tests.opensees.peer import answered
from tests.proof.generator.files import write_plan, write_recording
from tests.proof.generator.ground import shaking
from tests.proof.generator.motion import Array, Motion, random_motion
from tests.proof.generator.noise import Colour

RATE, FINER = 256, 4  # Hz of the recordings; steps of OpenSees in one sample
NOISE = {"low": (0.005, 5e-6), "high": (0.02, 2e-5)}  # share of the output's deviation; m of a displacement
OFF, DAMPING_OFF = 0.03, 0.1  # largest relative error of a planned stiffness, of a planned damping
CORNER, FLICKER = 25.0, 0.1  # Hz and share: the colour of the noise
MASS, DAMPING = 4e4, 0.02  # kg, ratio: of a storey
LAWS = {"specimen": SPECIMENS, "structure": STRUCTURES}


@dataclass(frozen=True)
class Case:
    """One case: kind of test, name of the law, level of noise, seed, and duration (s) of each recording."""

    kind: str
    law: str
    noise: str
    seed: int
    duration: float = 20.0

    @property
    def name(self) -> str:
        return f"{self.kind}-{self.law}-{self.noise}"

    @property
    def truth(self) -> Law:
        return LAWS[self.kind][self.law]

    def write(self, folder: Path) -> None:
        """Write plan.yaml, fit.h5 and two recordings with other waveforms, heldout1.h5 and heldout2.h5."""
        folder.mkdir(parents=True)
        number = list(LAWS[self.kind]).index(self.law)
        random = np.random.default_rng([self.seed, len(self.kind), number, list(NOISE).index(self.noise)])
        plan, recordings = (_specimen if self.kind == "specimen" else _storey)(self, random)
        write_plan(folder / "plan.yaml", {"schema": "rths-plan/1", "name": "Linear", "controller_rate": RATE, **plan})
        for name, channels in zip(("fit.h5", "heldout1.h5", "heldout2.h5"), recordings, strict=True):
            write_recording(folder / name, self.kind, 1 / RATE, channels)


def cases(seed: int, only: str = "") -> list[Case]:
    """Every law of both kinds of test at both levels of noise, whose names contain `only`."""
    every = [Case(kind, law, noise, seed) for kind, laws in LAWS.items() for law in laws for noise in NOISE]
    return [one for one in every if only in one.name]


def _specimen(case: Case, random: np.random.Generator) -> tuple[dict[str, Any], list[dict[str, Array]]]:
    """Fitted are cycles of four amplitudes; held out are an earthquake and band noise of other amplitudes."""
    peak, law = 0.03 * float(2 ** random.uniform(-0.5, 0.5)), case.truth
    stiffness = 2e6 * float(2 ** random.uniform(-1, 1))
    kinds = (("cycles", 1.0), ("earthquake", random.uniform(0.8, 1.1)), ("noise", random.uniform(0.6, 0.8)))
    motions = [random_motion(random, kind, float(share) * peak, case.duration) for kind, share in kinds]
    scale = Scale(peak, float(np.max(np.abs(motions[0].sample(_times(case), 1)))), stiffness, random)
    materials, share, moved = law.materials(scale), *NOISE[case.noise]
    planned = {"stiffness": stiffness, "damping": light_damping(scale)}
    if law.viscous:
        planned = {"stiffness": 0.0, "damping": scale.force / (0.6 * scale.v)}
    else:
        materials.append(dashpot(planned["damping"]))
    forces = [_pressed(materials, motion, case) for motion in motions]
    colour = Colour(share * float(np.std(forces[0])), 1 / RATE, CORNER, FLICKER)
    recordings: list[dict[str, Array]] = []
    for motion, force in zip(motions, forces, strict=True):
        x = motion.sample(_times(case))[::FINER]
        noisy = x + moved * random.standard_normal(len(x))
        recordings.append({"x_meas.1": noisy, "f_meas.1": force[::FINER] + colour.drawn(random, len(x))})
    damper = {name: value * (1 + random.uniform(-OFF, OFF)) for name, value in planned.items()}
    return {
        "test": "specimen",
        "drive": {"amplitude": 0.01, "shape": {"kind": "sine", "frequency": 0.5, "cycles": 5}},
        "stations": [
            {
                "name": "Specimen",
                "compensator": {"kind": "none"},
                "actuator": {"kind": "first_order_delay", "alpha": 1.0, "velocity_limit": 2.0},
                "specimen": {"kind": "linear", **{name: float(value) for name, value in damper.items()}},
            }
        ],
    }, recordings


def _storey(case: Case, random: np.random.Generator) -> tuple[dict[str, Any], list[dict[str, Array]]]:
    """Fitted is an earthquake; held out are a weaker earthquake and a sweep. The law is sized by the linear response."""
    frequency, peak = random.uniform(0.9, 1.8), float(random.uniform(2.0, 3.5))
    stiffness = MASS * float(2 * np.pi * frequency) ** 2
    damping = DAMPING * critical(MASS, stiffness)
    grounds = [shaking(random, share * peak, case.duration) for share in (1.0, float(random.uniform(0.6, 0.8)))]
    grounds.append(random_motion(random, "sweep", 0.3 * peak, case.duration))
    plain = _shaken([["Elastic", stiffness], dashpot(damping)], grounds[0], case)
    fastest = float(np.max(np.abs(np.gradient(plain, 1 / RATE / FINER))))
    scale = Scale(float(np.max(np.abs(plain))), fastest, stiffness, random)
    materials, share = [*case.truth.materials(scale), dashpot(damping)], NOISE[case.noise][0]
    floors = [_shaken(materials, ground, case)[::FINER] for ground in grounds]
    colour = Colour(share * float(np.std(floors[0])), 1 / RATE, CORNER, FLICKER)
    recordings: list[dict[str, Array]] = []
    for ground, floor in zip(grounds, floors, strict=True):
        felt = ground.sample(_times(case))[::FINER]
        noisy = felt + 2e-4 * peak * random.standard_normal(len(felt))
        recordings.append({"x_floor.1": floor + colour.drawn(random, len(floor)), "ag": noisy})
    storey = {"mass": MASS, "stiffness": float(stiffness * (1 + random.uniform(-OFF, OFF)))}
    ratio = float(DAMPING * (1 + random.uniform(-DAMPING_OFF, DAMPING_OFF)))
    sampled = grounds[0].sample(np.arange(0.0, case.duration, 0.02))
    return {
        "test": "structure",
        "duration": case.duration,
        "structure": {"kind": "shear_building", "storeys": [storey], "damping_ratio": ratio},
        "integrator": {"kind": "cr", "dt": 1 / RATE, "substeps": 1},
        "motion": {"kind": "inline", "dt": 0.02, "acceleration": sampled.tolist()},
    }, recordings


def _times(case: Case) -> Array:
    return np.arange(int(case.duration * RATE) * FINER) / RATE / FINER


def _pressed(materials: list[list[Any]], motion: Motion, case: Case) -> Array:
    x, v = (motion.sample(_times(case), order).tolist() for order in (0, 1))
    request = {"task": "pressed", "materials": materials, "displacement": x, "velocity": v, "dt": 1 / RATE / FINER}
    return np.array(answered(request)["force"])


def _shaken(materials: list[list[Any]], ground: Motion, case: Case) -> Array:
    felt = ground.sample(_times(case)).tolist()
    request = {"task": "shaken", "materials": materials, "mass": MASS, "acceleration": felt, "dt": 1 / RATE / FINER}
    return np.array(answered(request)["displacement"])
