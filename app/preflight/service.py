"""Preflight of a plan that is not queued yet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from app.checking import checked
from app.models import Rig
from app.preflight.process import Capacities, DryRuns, Order
from app.preflight.schemas import PreflightIn
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary


class PreflightService:
    """Rules of a preflight. No HTTP. `rig_of` gives the rig with an id, and raises RthsError where it takes no tests."""

    def __init__(self, motions: MotionLibrary, runs: DryRuns, rig_of: Callable[[str], Rig]):
        self.motions, self.runs, self.rig_of = motions, runs, rig_of

    def preflight(self, asked: PreflightIn) -> dict[str, Any]:
        """The preflight of the plan. Raises RthsError as the check does and for the rig, and Unavailable."""
        try:
            plan = checked(asked.plan, self.motions).plan
        except RthsError as error:
            issues = [replace(issue, where=".".join(filter(None, ("plan", issue.where)))) for issue in error.issues]
            raise PlanError(issues) from None
        return self.runs.execute(Order(plan.as_dict(), self.motions.folder, self._capacities(asked, len(plan.stations))))

    def _capacities(self, asked: PreflightIn, stations: int) -> list[Capacities | None]:
        """The capacities of the actuator of each station; a rig may have more actuators than the plan has stations."""
        if asked.rig is not None and asked.capacities:
            raise PlanError(Issue("capacities", "are those of the rig where a rig is given", None, "leave one of them out"))
        if asked.rig is not None:
            actuators = self.rig_of(asked.rig).actuators[:stations]
            return [(one.get("stroke"), one.get("velocity"), one.get("force")) for one in actuators]
        given = len(asked.capacities)
        if given > stations:
            fix = "give one capacity for each station, in their order"
            raise PlanError(Issue("capacities", f"has {given} entries for {stations} stations", given, fix))
        return [None if one is None else (one.stroke, one.velocity, one.force) for one in asked.capacities]
