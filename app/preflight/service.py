"""Preflight of a plan that is not queued yet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from app.checking import checked
from app.models import EMULATED, Rig
from app.preflight.calculation import Capacities, dry_run, identified
from app.preflight.identified import IdentificationIn, IdentificationOut
from app.preflight.refusal import with_refusals
from app.preflight.schemas import PreflightIn, PreflightOut
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan


class PreflightService:
    """Rules of a preflight. No HTTP. `rig_of` gives the rig with an id, and raises RthsError where it takes no tests."""

    def __init__(self, motions: MotionLibrary, rig_of: Callable[[str], Rig]):
        self.motions, self.rig_of = motions, rig_of

    def rig(self, asked: PreflightIn) -> Rig | None:
        """The rig that a submission would name, by default the emulated laboratory; None where capacities are given instead."""
        if asked.rig is not None and asked.capacities:
            raise PlanError(Issue("capacities", "are those of the rig where a rig is given", None, "leave one of them out"))
        return None if asked.capacities else self.rig_of(EMULATED if asked.rig is None else asked.rig)


def preflight(asked: PreflightIn, rig: Rig | None, motions: MotionLibrary) -> PreflightOut:
    """The preflight of a plan, in the process of a calculation. Raises RthsError as the check does."""
    plan = _checked(asked.plan, motions)
    capacities = _given(asked, len(plan.stations)) if rig is None else _of_rig(rig, len(plan.stations))
    return PreflightOut(**with_refusals(dry_run(plan.as_dict(), motions.folder, capacities), plan, rig))


def identify(asked: IdentificationIn, motions: MotionLibrary) -> IdentificationOut:
    """The delay of a station, in the process of a calculation. Raises RthsError as the check does and for the test."""
    plan = _checked(asked.plan, motions)
    settings = asked.model_dump(exclude={"plan", "station"}, exclude_none=True)
    return IdentificationOut(**identified(plan.as_dict(), asked.station, settings))


def _checked(data: Any, motions: MotionLibrary) -> Plan:
    """The plan, with the paths of its issues below `plan`."""
    try:
        return checked(data, motions).plan
    except RthsError as error:
        issues = [replace(issue, where=".".join(filter(None, ("plan", issue.where)))) for issue in error.issues]
        raise PlanError(issues) from None


def _of_rig(rig: Rig, stations: int) -> list[Capacities | None]:
    """The capacities of the actuators that the stations get; a rig may have more actuators than these, or fewer."""
    return [(one.get("stroke"), one.get("velocity"), one.get("force")) for one in rig.actuators[:stations]]


def _given(asked: PreflightIn, stations: int) -> list[Capacities | None]:
    given = len(asked.capacities)
    if given > stations:
        fix = "give one capacity for each station, in their order"
        raise PlanError(Issue("capacities", f"has {given} entries for {stations} stations", given, fix))
    return [None if one is None else (one.stroke, one.velocity, one.force) for one in asked.capacities]
