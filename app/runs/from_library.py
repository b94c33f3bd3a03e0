"""The rule of the library: an operator queues a version of a plan in the library as it is. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from app.checking import checked
from app.models import LibraryPlan, PlanVersion, Run
from app.problems import Forbidden
from rths_engine.foundation.errors import RthsError
from rths_engine.parts.ground_motions import MotionLibrary

WHO = "An operator, or an API token without the scope submit,"
HOW = "Choose a plan on the page Plans, or ask an engineer to queue this plan."


def check_as_kept(runs: Sequence[Run], kept: tuple[LibraryPlan, PlanVersion] | None, motions: MotionLibrary) -> None:
    """Raise Forbidden unless every run has the whole plan of the version `kept`, pace, name and address of a client included.

    The digest of a plan would not do: it leaves out what does not change the result, such as the pace at which a rig moves.
    """
    if kept is None:
        raise Forbidden(f"{WHO} queues plans of the library as they are, and no version of the library is named. {HOW}")
    plan, version = kept
    called = f"{plan.name}, version {version.number}"
    if plan.archived_at is not None:
        raise Forbidden(f"{WHO} queues plans that are in use, and {called}, is archived. {HOW}")
    try:
        whole = checked(version.plan, motions).plan.as_dict()
    except RthsError as error:
        raise Forbidden(f"{called}, is not valid any more: {error}. {HOW}") from None
    for run in runs:
        if different := _different(run.plan, whole):
            how = f"This plan differs from {called}, in {different}"
            raise Forbidden(f"{WHO} queues plans of the library as they are. {how}. {HOW}")


def _different(plan: dict[str, Any], kept: dict[str, Any]) -> str:
    """The keys in which a plan differs from the one that is kept."""
    return ", ".join(key for key in {**kept, **plan} if plan.get(key) != kept.get(key))
