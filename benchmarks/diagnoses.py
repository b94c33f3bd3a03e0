"""Time of a diagnosis of a specimen test and of a hybrid test, each of 40 s at 1024 Hz with Coulomb friction left out."""

from __future__ import annotations

import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

from rths_engine.diagnosis.verdict import diagnose
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan
from rths_engine.recordings import opening
from rths_engine.recordings import run_file as recording
from rths_engine.running.run import simulate

ROUNDS = 3
DURATION = 40.0
LEFT_OUT = CoulombFriction(friction=5e3, presliding=1e-4)


def diagnoses() -> dict[str, float]:
    """Wall time (s) from the recording to the verdict, with two threads."""
    return {
        "diagnosis_specimen_s": _timed(templates.template("specimen-mr-damper")),
        "diagnosis_hybrid_s": _timed(templates.template("two-storeys")),
    }


def _timed(plan: Plan) -> float:
    plan = plan.model_copy(update={"duration": DURATION})
    first, *others = plan.stations
    rig = plan.model_copy(update={"stations": (first.model_copy(update={"specimen_physics": (LEFT_OUT,)}), *others)})
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "test.h5"
        recording.save(path, simulate(rig))
        recorded = opening.load(path)
    seconds = []
    for _ in range(ROUNDS):
        start = perf_counter()
        found = diagnose(plan, recorded).verdict
        seconds.append(perf_counter() - start)
    assert [one.component for one in found.effects] == ["specimen:1"], found.effects
    return median(seconds)
