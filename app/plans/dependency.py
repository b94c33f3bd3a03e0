"""The plan service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import Library
from app.plans.service import PlanService


def plan_service(motions: Library) -> PlanService:
    """The service of plans."""
    return PlanService(motions)


Plans = Annotated[PlanService, Depends(plan_service)]
