"""Checks before a plan is queued: the plan is valid, its record exists, and its scaling and size are within bounds."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calculations.answer import HERE, Calculate
from app.calculations.bound import Bound
from app.text import refuse_unstorable
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions import Motion, MotionLibrary
from rths_engine.planning.model import Model
from rths_engine.planning.motion import FileMotion, NoMotion, RecordMotion
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_model
from rths_engine.results.channels import channels

LARGEST_PEAK = 100 * STANDARD_GRAVITY  # far above any earthquake, so that only a wrong unit or scale is refused
LARGEST_RECORDING = 2_000_000_000  # bytes; the same as the engine's, which is not imported here
BYTES = 8  # size of a recorded number
BRIEF = 16_384  # characters of plans that are checked at once: a plan of 100 storeys has 9000 and takes a tenth of a second
PLANS = Bound("check of the plans", seconds=90, megabytes=4000, mend="give fewer or shorter plans at a time")


@dataclass(frozen=True, slots=True)
class Checked:
    """A valid plan with the checksum of its record, and its scale factor, PGA, duration and number of steps; SI."""

    model: Model
    scale_factor: float
    pga: float
    duration_s: float
    moved_s: float
    steps: int

    @property
    def plan(self) -> Plan:
        return self.model.plan


@dataclass(frozen=True, slots=True)
class Outline:
    """A valid plan with the checksum of its record, its number of floors, its duration (s) and its number of steps."""

    plan: Plan
    floors: int
    duration_s: float
    steps: int


def outlines(calculate: Calculate, plans: Sequence[Any], motions: MotionLibrary) -> list[Outline | RthsError]:
    """Check plans: the outline of each, or the error with every issue. Long plans are checked in a process of their own."""
    brief = len(json.dumps(plans)) <= BRIEF
    return (HERE if brief else calculate)(PLANS, _outlines, plans, motions)


def _outlines(plans: Sequence[Any], motions: MotionLibrary) -> list[Outline | RthsError]:
    found: list[Outline | RthsError] = []
    for data in plans:
        try:
            good = checked(data, motions)
            found.append(Outline(good.plan, len(good.model.periods), good.duration_s, good.steps))
        except RthsError as error:
            found.append(error)
    return found


def checked(data: Any, motions: MotionLibrary) -> Checked:
    """Check a plan. Raises PlanError or MotionError with every issue; reads no file of the server except its records."""
    refuse_unstorable(data)
    model = read_model(data)
    plan = model.plan
    if not plan.name.strip():
        raise PlanError(Issue("name", "is blank", plan.name, "give the test a name"))
    if isinstance(plan.motion, FileMotion):
        fix = "upload the record and give its name"
        raise PlanError(Issue("motion.kind", "only the command line reads a record from a path", plan.motion.path, fix))
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
    _check_peak("motion", motion.pga, "give the acceleration in m/s^2")
    with np.errstate(over="ignore", divide="ignore"):
        factor = float(plan.motion.scale.factor_for(motion, float(periods[0])))
    _check_peak("motion.scale", motion.pga * factor, "use a smaller scale")
    return factor


def _check_peak(where: str, pga: float, fix: str) -> None:
    if not pga <= LARGEST_PEAK:
        bound = f"the peak ground acceleration is above {LARGEST_PEAK / STANDARD_GRAVITY:g} g"
        raise PlanError(Issue(where, bound, f"{pga / STANDARD_GRAVITY:.3g} g", fix))


def _check_size(model: Model, steps: int) -> None:
    plan = model.plan
    substeps, columns = steps * plan.substeps, len(channels(model))
    if substeps * columns * BYTES > LARGEST_RECORDING:
        problem = f"{substeps} substeps of {columns} channels exceed {LARGEST_RECORDING / 1e9:g} GB"
        raise PlanError(Issue("duration", problem, plan.duration, "shorten the test or lower the controller rate"))
