"""What must hold before a plan is queued: it can be read, its record is there, and its scaling and its size are possible."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.text import refuse_unstorable
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import Motion, MotionLibrary
from rths_engine.planning.model import Model
from rths_engine.planning.motion import FileMotion, NoMotion, RecordMotion
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_model
from rths_engine.results.channels import channels

LARGEST_PEAK = 100 * STANDARD_GRAVITY  # far above any shaking, so that only a wrong unit or scale is refused
LARGEST_RECORDING = 2_000_000_000  # bytes, as in the engine, which is not loaded here
BYTES = 8  # of a recorded number


@dataclass(frozen=True, slots=True)
class Checked:
    """A plan that can be run, its record pinned by checksum, and what it amounts to; SI."""

    model: Model
    scale_factor: float
    pga: float
    duration_s: float
    moved_s: float
    steps: int

    @property
    def plan(self) -> Plan:
        return self.model.plan


def checked(data: Any, motions: MotionLibrary) -> Checked:
    """Raises PlanError or MotionError with every issue found; nothing of the server's files is read but its library."""
    refuse_unstorable(data)
    model = read_model(data)
    plan = model.plan
    if isinstance(plan.motion, FileMotion):
        fix = "upload the record and name it"
        raise PlanError(Issue("motion.kind", "files are read by the command line only", plan.motion.path, fix))
    motion = plan.motion.unscaled(motions)
    if isinstance(plan.motion, RecordMotion):
        model = model.changed(motion=plan.motion.model_copy(update={"sha256": motion.sha256}))
        plan = model.plan
    factor = _scale_factor(plan, motion, model.periods)
    steps = max(1, math.ceil(plan.length(motion.duration) / plan.step - 1e-9))
    _check_size(model, steps)
    return Checked(model, factor, motion.pga * factor, plan.length(motion.duration), plan.moved(motion.duration), steps)


def _scale_factor(plan: Plan, motion: Motion, periods: Array) -> float:
    if isinstance(plan.motion, FileMotion | NoMotion):
        return 1.0
    _check_peak("motion", motion.pga, "give acceleration in m/s^2")
    with np.errstate(over="ignore", divide="ignore"):
        factor = float(plan.motion.scale.factor_for(motion, float(periods[0])))
    _check_peak("motion.scale", motion.pga * factor, "scale it by less")
    return factor


def _check_peak(where: str, pga: float, fix: str) -> None:
    if not pga <= LARGEST_PEAK:
        bound = f"peaks above {LARGEST_PEAK / STANDARD_GRAVITY:g} g"
        raise PlanError(Issue(where, bound, f"{pga / STANDARD_GRAVITY:.3g} g", fix))


def _check_size(model: Model, steps: int) -> None:
    plan = model.plan
    substeps, columns = steps * plan.substeps, len(channels(model))
    if substeps * columns * BYTES > LARGEST_RECORDING:
        problem = f"{substeps} substeps of {columns} channels would not fit in {LARGEST_RECORDING / 1e9:g} GB"
        raise PlanError(Issue("duration", problem, plan.duration, "shorten the test or lower the controller rate"))
