"""Preflight of a plan as one JSON object: the dry run, what it uses of every limit, floors, stability and times.

Numbers are SI unless their key names a unit; values of floors are in the shown unit. A dry run tells what the models of the
plan do. It cannot tell what a specimen or an actuator does that these models leave out: docs/preflight.md.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.connections import modelled, predicted
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.preflight.dry_run import DryRun, dry_run, without_limits
from rths_engine.preflight.margins import margins
from rths_engine.preflight.outlook import sentence, trip_of
from rths_engine.preflight.uses import Capacity, Use, uses
from rths_engine.results.measure import FloorMeasure
from rths_engine.results.measures import of
from rths_engine.results.signals import RunSignals

OF_CLIENT = "Not simulated: the client computes the displacements during the test. The limits act in every controller step."
# chosen; see docs/decisions/0023
BUDGET_S = 9.0  # wall time of a preflight: a third each for the dry run, the one without limits, and stability
SLOW = 1.05  # times the planned wall time: beyond it the computer is too slow for the pace
GROWN = 100.0  # times a limit: a command or force that reaches it without limits grows without bound


def preflight(
    planned: Plan | Model,
    motions: MotionLibrary | None = None,
    capacities: Sequence[Capacity | None] = (),
    budget_s: float = BUDGET_S,
) -> dict[str, Any]:
    """The preflight of a plan, within about `budget_s` seconds of wall time. Raises PlanError or MotionError.

    Where the dry run trips, the plan is simulated once more without limits, and `uses` and `floors` are of that simulation:
    they tell by how much each limit is exceeded. `capacities` are those of the rig's actuators, one for each station.
    """
    given, library = Model.of(planned), motions or MotionLibrary(None)
    if given.plan.test == "client":
        return _of_client(given.plan)
    model = modelled(given)
    share = budget_s / 3
    dry = dry_run(model, library, share)
    free = dry_run(without_limits(model), library, share) if dry.run.trip else None
    shown = free or dry
    used = uses(shown, model.plan.stations, capacities)
    return {
        "name": model.plan.name,
        "verdict": "trips" if dry.run.trip else "completes" if dry.complete else "incomplete",
        "sentence": sentence(dry, used),
        "trip": trip_of(dry.run.trip) if dry.run.trip else None,
        "without_limits": free is not None,
        "uses": [use.as_dict() for use in used],
        "floors": _floors(shown),
        "stability": margins(model, time.perf_counter() + share),
        "open_ended": False,
        "duration_s": dry.planned_s,
        "covered_s": shown.covered_s,
        "expected_elapsed_s": _expected(dry, free),
        "notes": [*predicted(given.plan), *_notes(dry, free, used)],
    }


def _of_client(plan: Plan) -> dict[str, Any]:
    """The preflight of a test with a client, whose displacements are not known before it."""
    nothing: dict[str, Any] = {"trip": None, "without_limits": False, "uses": [], "floors": [], "stability": None}
    return {
        "name": plan.name,
        "verdict": "incomplete",
        "sentence": OF_CLIENT,
        **nothing,
        "open_ended": True,
        "duration_s": plan.length(0.0),
        "covered_s": 0.0,
        "expected_elapsed_s": None,
        "notes": [],
    }


@np.errstate(over="ignore", invalid="ignore")
def _floors(dry: DryRun) -> list[dict[str, Any]]:
    """Every measure of the floors, each with one value for a floor, from the ground up."""
    result = dry.result
    whole = RunSignals(result.model, result.dt, result.channels, result.signals, result.history[0, 0])
    return [
        {
            "key": one.key,
            "label": one.label,
            "meaning": one.meaning,
            "shown_label": one.shown_label,
            "decimals": one.decimals,
            "values": [one.in_shown(value) for value in one.compute(whole)],
        }
        for one in of(FloorMeasure, result.plan.test)
    ]


def _expected(dry: DryRun, free: DryRun | None) -> float | None:
    """Expected wall time (s) of the whole test at its pace; None where only the first step was simulated."""
    longer = free or dry
    if longer.covered_s <= longer.run.plan.step:
        return None
    computed = longer.elapsed_s / longer.covered_s * dry.planned_s
    pace = dry.run.plan.pace
    return max(computed, dry.planned_s / pace.factor) if pace.kind == "real_time" else computed


def _notes(dry: DryRun, free: DryRun | None, used: Sequence[Use]) -> list[str]:
    found = []
    if free is not None:
        found.append("Peaks are those of a second simulation without safety limits.")
        if free.run.trip or any(use.against == "limit" and not use.share < GROWN for use in used):
            found.append("Without its limits the response grows without bound.")
        elif not free.complete:
            found.append(f"The simulation without limits covers the first {free.covered_s:.3g} s of {dry.planned_s:.4g} s.")
    saturated = {(use.station, use.quantity): use for use in used if use.against == "actuator" and use.share >= 1 - 1e-9}
    for use in saturated.values():
        found.append(f"Station {use.station} ({use.name}): the {use.label} reaches the capacity of the actuator.")
    for use in used:
        if use.against == "rig" and not use.share <= 1:
            found.append(f"Station {use.station} ({use.name}): the {use.label} exceeds the capacity of the rig.")
    pace, expected = dry.run.plan.pace, _expected(dry, free)
    if pace.kind == "real_time" and expected is not None and expected > SLOW * dry.planned_s / pace.factor:
        found.append("This computer is too slow for the pace of the plan.")
    return found
