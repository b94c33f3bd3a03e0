"""`python benchmarks/one_diagnosis.py CASE`: processor time, peak memory and verdict of a diagnosis, in a process of its own.

The file uses nothing of the program that has changed since commit 8847707. It therefore also measures a clone of that commit,
with the clone on PYTHONPATH.
"""

from __future__ import annotations

import json
import resource
import sys
import tempfile
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np

from rths_engine.diagnosis.verdict import diagnose
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.parts.physics.structure.cubic_stiffness import CubicStiffness
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.planning.shapes import BandNoise
from rths_engine.recordings import opening, run_file
from rths_engine.recordings.measured import Measured, MeasuredChannel
from rths_engine.running import replay
from rths_engine.running.run import simulate

DURATION = 40.0
HYBRID = "two-storeys" if "two-storeys" in templates.names() else "table3-04"  # its name in earlier builds
LEFT_OUT = CoulombFriction(friction=5e3, presliding=1e-4)
FINER = 16  # steps in a sample of the made measurements
SPRING = LinearSpecimen(stiffness=2.0e6, damping=8.0e5)
STOREYS = [{"mass": 4e4, "stiffness": 2.2e7}, {"mass": 3e4, "stiffness": 2.1e7}, {"mass": 2.5e4, "stiffness": 1.7e7}]


def run(name: str) -> tuple[Plan, Measured]:
    """A recording of this program: 40 s at 1024 Hz with Coulomb friction left out."""
    plan = templates.template(name).model_copy(update={"duration": DURATION})
    first, *others = plan.stations
    rig = plan.model_copy(update={"stations": (first.model_copy(update={"specimen_physics": (LEFT_OUT,)}), *others)})
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "test.h5"
        run_file.save(path, simulate(rig))
        return plan, opening.load(path)


def specimen(samples: int, rate: float) -> tuple[Plan, Measured]:
    """A measured specimen with Coulomb friction left out, noise on force and displacement, and a spring 4 % off its plan."""
    rig = {"compensator": {"kind": "none"}, "specimen": SPRING.model_dump()}
    drive = {"amplitude": 0.02, "shape": {"kind": "sine"}}
    plan = read_plan(
        {"test": "specimen", "stations": [rig], "controller_rate": rate, "drive": drive, "duration": samples / rate}
    )
    time = np.arange(samples * FINER) / rate / FINER
    fine = 0.04 * BandNoise(low_frequency=0.1, high_frequency=2.5, duration=samples / rate, seed=1).sample(time)
    true = SPRING.model_copy(update={"stiffness": 1.04 * SPRING.stiffness})
    force = replay.specimen(true, (LEFT_OUT,), fine, np.ones(len(fine)), 1 / rate / FINER)[::FINER]
    random = np.random.default_rng(1)
    force += 0.005 * np.std(force) * random.standard_normal(samples)
    x = fine[::FINER] + 1e-5 * random.standard_normal(samples)
    return plan, Measured(1 / rate, (MeasuredChannel("x_meas", 1, x, "m"), MeasuredChannel("f_meas", 1, force, "N")))


def structure(samples: int, rate: float) -> tuple[Plan, Measured]:
    """The measured floor accelerations of three storeys, of which the second stiffens with its drift."""
    building = {"kind": "shear_building", "storeys": STOREYS, "damping_ratio": 0.02}
    plan = read_plan({"test": "structure", "structure": building, "duration": samples / rate})
    steps = np.arange(samples * FINER) / rate / FINER
    ground = 2.0 * BandNoise(low_frequency=0.3, high_frequency=8.0, duration=samples / rate, seed=2).sample(steps)
    integrator = plan.integrator.model_copy(update={"dt": 1 / rate / FINER, "substeps": 1})
    left_out = (CubicStiffness(storey=2, stiffness=4e10),)
    true = plan.model_copy(update={"integrator": integrator, "structure_physics": left_out})
    x = replay.structure(true, ground[:, None], np.zeros((len(ground), len(plan.stations)))).floors
    random = np.random.default_rng(2)
    channels = [MeasuredChannel("ag", 0, ground[::FINER], "m/s^2")]
    for floor, moved in enumerate(x.T, start=1):
        a = np.gradient(np.gradient(moved, 1 / rate / FINER), 1 / rate / FINER)[::FINER] + ground[::FINER]
        noise = 0.01 * np.std(a) * random.standard_normal(samples)
        channels.append(MeasuredChannel("a_floor", floor, a + noise, "m/s^2"))
    return plan, Measured(1 / rate, tuple(channels))


CASES: dict[str, Any] = {
    "specimen": lambda: run("specimen-mr-damper"),
    "hybrid": lambda: run(HYBRID),
    "specimen_8000": lambda: specimen(8000, 200.0),
    "specimen_80000": lambda: specimen(80_000, 200.0),
    "structure_1300": lambda: structure(1300, 100.0),
}


def main(name: str) -> None:
    """Diagnose the recording of the case and print the figures as JSON."""
    plan, recording = CASES[name]()
    diagnose(*specimen(400, 100.0))  # loads the compiled code
    used, started = process_time(), perf_counter()
    verdict = diagnose(plan, recording).verdict
    found = {
        "cpu_s": round(process_time() - used, 2),
        "wall_s": round(perf_counter() - started, 2),
        "peak_mb": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024),
        "effects": [f"{effect.component}/{effect.id}" for effect in verdict.effects],
        "heldout_nrmse": verdict.fit.extended.heldout_nrmse,
    }
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1])
