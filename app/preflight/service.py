"""Preflight of a plan that is not queued yet."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from app.checking import checked
from app.preflight.process import DryRuns, Order
from app.preflight.schemas import PreflightIn
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary


class PreflightService:
    """Rules of a preflight. No HTTP."""

    def __init__(self, motions: MotionLibrary, runs: DryRuns):
        self.motions, self.runs = motions, runs

    def preflight(self, asked: PreflightIn) -> dict[str, Any]:
        """The preflight of the plan. Raises PlanError or MotionError as the check does, and Unavailable."""
        try:
            plan = checked(asked.plan, self.motions).plan
        except RthsError as error:
            issues = [replace(issue, where=".".join(filter(None, ("plan", issue.where)))) for issue in error.issues]
            raise PlanError(issues) from None
        stations, given = len(plan.stations), len(asked.capacities)
        if given > stations:
            fix = "give one capacity for each station, in their order"
            raise PlanError(Issue("capacities", f"has {given} entries for {stations} stations", given, fix))
        capacities = [None if one is None else (one.stroke, one.velocity, one.force) for one in asked.capacities]
        return self.runs.execute(Order(plan.as_dict(), self.motions.folder, capacities))
