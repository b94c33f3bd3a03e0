"""REST endpoints of retention."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query

from app.access import Role, allowed
from app.retention.dependency import Retained
from app.retention.schemas import ENDED, MOST_DAYS, MOST_GIGABYTES, Ended, Preview, RetentionOut, Rule, RuleIn
from app.text import Storable

router = APIRouter(prefix="/api/v1", tags=["retention"])


@router.get("/retention")
@allowed(Role.VIEWER)
def shown(retention: Retained) -> RetentionOut:
    """The rule that removes recordings of runs. At first all recordings are kept."""
    return retention.shown()


@router.put("/retention")
@allowed(Role.ADMINISTRATOR)
def save(retention: Retained, rule: Annotated[RuleIn, Body()]) -> RetentionOut:
    """Set the rule. A changed rule removes nothing within 24 hours; then recordings are removed once a day."""
    return retention.save(rule)


@router.get("/retention/preview")
@allowed(Role.ADMINISTRATOR)
def preview(
    retention: Retained,
    days: Annotated[int | None, Query(ge=1, le=MOST_DAYS)] = None,
    gigabytes: Annotated[float | None, Query(gt=0, le=MOST_GIGABYTES)] = None,
    states: Annotated[list[Ended] | None, Query(max_length=len(ENDED))] = None,
    template: Annotated[Storable, Query(max_length=80)] = "",
    tag: Annotated[Storable, Query(max_length=40)] = "",
) -> Preview:
    """What a rule would remove now; without `days` and `gigabytes`, what the rule that holds would remove."""
    if days is None and gigabytes is None:
        return retention.preview()
    return retention.preview(Rule(days=days, gigabytes=gigabytes, states=states or [], template=template, tag=tag))
