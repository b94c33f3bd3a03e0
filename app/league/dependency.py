"""The league service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import Configured
from app.league.service import LeagueService


def league_service(settings: Configured) -> LeagueService:
    """The service of the league."""
    return LeagueService(settings.data)


Leagues = Annotated[LeagueService, Depends(league_service)]
