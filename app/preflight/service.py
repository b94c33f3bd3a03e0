"""Preflight of a plan that is not queued yet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from app.checking import checked
from app.models import EMULATED, Rig
from app.preflight.identified import IdentificationIn
from app.preflight.process import Capacities, DryRuns, Identification, Order
from app.preflight.refusal import with_refusals
from app.preflight.schemas import PreflightIn
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan


class PreflightService:
    """Rules of a preflight. No HTTP. `rig_of` gives the rig with an id, and raises RthsError where it takes no tests."""

    def __init__(self, motions: MotionLibrary, runs: DryRuns, identifications: DryRuns, rig_of: Callable[[str], Rig]):
        self.motions, self.runs, self.identifications, self.rig_of = motions, runs, identifications, rig_of

    def preflight(self, asked: PreflightIn) -> dict[str, Any]:
        """The preflight of the plan. Raises RthsError as the check does and for the rig, and Unavailable."""
        plan = self._checked(asked.plan)
        rig = self._rig(asked)
        capacities = _given(asked, len(plan.stations)) if rig is None else _of_rig(rig, len(plan.stations))
        found = self.runs.execute(Order(plan.as_dict(), self.motions.folder, capacities))
        return with_refusals(found, plan, rig)

    def identify(self, asked: IdentificationIn) -> dict[str, Any]:
        """The delay of a station by a random test. Raises RthsError as the check does and for the test, and Unavailable."""
        plan = self._checked(asked.plan)
        settings = asked.model_dump(exclude={"plan", "station"}, exclude_none=True)
        return self.identifications.execute(Identification(plan.as_dict(), asked.station, settings))

    def _checked(self, data: Any) -> Plan:
        """The plan, with the paths of its issues below `plan`."""
        try:
            return checked(data, self.motions).plan
        except RthsError as error:
            issues = [replace(issue, where=".".join(filter(None, ("plan", issue.where)))) for issue in error.issues]
            raise PlanError(issues) from None

    def _rig(self, asked: PreflightIn) -> Rig | None:
        """The rig that a submission would name, by default the emulated laboratory; None where capacities are given instead."""
        if asked.rig is not None and asked.capacities:
            raise PlanError(Issue("capacities", "are those of the rig where a rig is given", None, "leave one of them out"))
        return None if asked.capacities else self.rig_of(EMULATED if asked.rig is None else asked.rig)


def _of_rig(rig: Rig, stations: int) -> list[Capacities | None]:
    """The capacities of the actuators that the stations get; a rig may have more actuators than these, or fewer."""
    return [(one.get("stroke"), one.get("velocity"), one.get("force")) for one in rig.actuators[:stations]]


def _given(asked: PreflightIn, stations: int) -> list[Capacities | None]:
    given = len(asked.capacities)
    if given > stations:
        fix = "give one capacity for each station, in their order"
        raise PlanError(Issue("capacities", f"has {given} entries for {stations} stations", given, fix))
    return [None if one is None else (one.stroke, one.velocity, one.force) for one in asked.capacities]
