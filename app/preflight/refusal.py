"""What a preflight says of a plan that its rig would refuse, as the submission of the plan does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from app.models import Rig
from app.rigs.capacities import exceeded
from rths_engine.foundation.errors import Issue
from rths_engine.planning.plan import Plan


def with_refusals(found: dict[str, Any], plan: Plan, rig: Rig | None) -> dict[str, Any]:
    """The preflight with what the rig refuses: it decides the verdict, and the sentence of the dry run follows it."""
    issues = exceeded(plan, rig) if rig is not None else []
    refusals = [issue.as_dict() for issue in issues]
    if rig is None or not issues:
        return {**found, "refusals": refusals}
    said = [_worded(plan, issue) for issue in issues]
    more = f" {len(said) - 1} more in the notes." if len(said) > 1 else ""
    sentence = f"Would be refused by rig {rig.name}: {said[0]}.{more} Without this rig: {_uncapitalized(found['sentence'])}"
    notes = [f"Rig {rig.name} also refuses: {one}." for one in said[1:]]
    return {**found, "verdict": "refused", "sentence": sentence, "refusals": refusals, "notes": [*notes, *found["notes"]]}


def _worded(plan: Plan, issue: Issue) -> str:
    """`the force limit of station 1 (Brace), 300 kN, exceeds the force of 100 kN of actuator 1 of rig Wall`."""
    path: Sequence[str] = issue.where.split(".")
    if path == ["stations"]:
        return f"the plan {issue.problem}"
    if path[0] == "pace":
        return f"the speed factor, {issue.value:g}, {issue.problem}; {issue.fix}"
    number, limit = int(path[1]), path[-1]
    if limit == "connection":
        return f"station {number + 1} ({plan.stations[number].name}) {issue.problem}; {issue.fix}"
    return f"the {limit} limit of station {number + 1} ({plan.stations[number].name}), {issue.value}, {issue.problem}"


def _uncapitalized(sentence: str) -> str:
    return sentence[:1].lower() + sentence[1:]
