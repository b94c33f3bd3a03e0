"""The league service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import OneStore
from app.league.service import LeagueService


def league_service(store: OneStore) -> LeagueService:
    """The service of the league."""
    return LeagueService(store)


Leagues = Annotated[LeagueService, Depends(league_service)]
