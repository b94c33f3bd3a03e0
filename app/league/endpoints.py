"""REST endpoint of the league of compensators."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from app.access import Role, allowed
from app.league.dependency import Leagues
from app.league.schemas import LeagueOut
from app.openapi import told

router = APIRouter(prefix="/api/v1/league", tags=["runs"])
Case = Annotated[int, Query(ge=1, le=4, description="partitioning case of the benchmark")]


@router.get("", responses=told(404))
@allowed(Role.VIEWER)
def league(leagues: Leagues, case: Case = 1) -> LeagueOut:
    """Every compensator on the virtual RTHS benchmark: J1 to J9 on the nominal plant and over the perturbed plants."""
    return leagues.league(case)
