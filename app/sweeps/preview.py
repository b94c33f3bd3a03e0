"""A sweep before it is queued: points that are not valid, and predicted stability, of all points or of a random sample."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from app.calculations.bound import Bound
from app.checking import checked
from app.sweeps.schemas import Prediction, Refusal
from app.sweeps.shown import inputs_of
from app.text import refuse_unstorable
from rths_engine import stability
from rths_engine.foundation.errors import Issue, MotionError, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.model import Model
from rths_engine.sweeps.design import Design, read_design

LEAST = 10  # points that are examined however long they take
FIRST = 5  # invalid and unstable points that are listed
SEED = 0  # of the sample of points
EXAMINATION = Bound("examination of the sweep", seconds=20, megabytes=2000, mend="vary fewer fields or use fewer points")
ANALYSIS = Bound("analysis of the sweep", seconds=60, megabytes=3000, mend="ask for a page of its results")


@dataclass
class Examined:
    """The points that were examined, and what was found."""

    examined: int = 0
    invalid: int = 0
    durations_s: list[float] = field(default_factory=list)
    first_valid: int | None = None
    """The first examined point (from 0) that is valid."""
    first_invalid: list[Refusal] = field(default_factory=list)
    stability: Prediction = field(default_factory=lambda: Prediction(predicted=0, stable=0, unstable=0, first_unstable=[]))


def examination(data: Any, motions: MotionLibrary, within_s: float) -> tuple[Design, Examined]:
    """The design of a definition, and its examined points. Raises PlanError or MotionError with every issue."""
    design = read(data, motions)
    return design, examined(design, motions, within_s)


def read(data: Any, motions: MotionLibrary) -> Design:
    """The design of a definition, whose records exist. Raises PlanError or MotionError with every issue."""
    refuse_unstorable(data)
    design = read_design(data)
    if not design.definition.name.strip():
        raise PlanError(Issue("name", "is blank", design.definition.name, "give the sweep a name"))
    check_records(design, motions)
    return design


def examined(design: Design, motions: MotionLibrary, within_s: float) -> Examined:
    """Examine points in a random order, which is always the same: LEAST of them, and further ones for `within_s` seconds."""
    found = Examined()
    until = time.monotonic() + within_s
    order = np.random.Generator(np.random.PCG64(SEED)).permutation(design.count)
    for point in order.tolist():
        _examine(design, point, motions, found)
        if found.examined >= LEAST and time.monotonic() > until:
            break
    found.first_invalid.sort(key=lambda one: one.point)
    found.stability.first_unstable.sort(key=lambda one: one.point)
    return found


def _examine(design: Design, point: int, motions: MotionLibrary, found: Examined) -> None:
    found.examined += 1
    try:
        good = checked(design.named(point), motions)
    except RthsError as error:
        found.invalid += 1
        if len(found.first_invalid) < FIRST:
            found.first_invalid.append(refusal(design, point, "; ".join(str(issue) for issue in error.issues)))
        return
    found.durations_s.append(good.duration_s)
    found.first_valid = point if found.first_valid is None else found.first_valid
    said = _stability(good.model)
    if said is None:
        return
    found.stability.predicted += 1
    if said == "":
        found.stability.stable += 1
        return
    found.stability.unstable += 1
    if len(found.stability.first_unstable) < FIRST:
        found.stability.first_unstable.append(refusal(design, point, said))


def _stability(model: Model) -> str | None:
    """The warning of a point that is predicted unstable, empty for a stable point; None where nothing is predicted."""
    if model.plan.driven or not model.plan.stations:
        return None
    said = stability.warning(model)
    return "" if said is None else None if said.startswith("Stability is not predicted") else said


def refusal(design: Design, point: int, reason: str) -> Refusal:
    """A point (from 0) with the reason why it is listed."""
    return Refusal(point=point + 1, inputs=inputs_of(design, point), reason=reason)


def check_records(design: Design, motions: MotionLibrary) -> None:
    """Raise MotionError for each record that the library does not have, or that is damaged."""
    issues: list[Issue] = []
    for place, name in enumerate(design.records):
        try:
            found = motions.summary(name)
            issues += [Issue(f"records.{place}", found.problem, name)] if found.problem else []
        except MotionError as error:
            issues += [Issue(f"records.{place}", issue.problem, issue.value, issue.fix) for issue in error.issues]
    if issues:
        raise MotionError(issues)
