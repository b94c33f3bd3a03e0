"""The page of the settings, stored once for the whole laboratory, and the form of a data set for DesignSafe."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, Who, allowed
from app.events.tables import EventKind
from app.laboratory.dependency import OneLaboratory
from app.pages.errors import PageRoute
from app.pages.rendering import page
from app.publishing.designsafe.entities import LICENCES
from app.retention.schemas import ENDED
from app.runs.dependency import Runs

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/settings")
@allowed(Role.VIEWER)
def settings(request: Request, who: Who, laboratory: OneLaboratory) -> HTMLResponse:
    """The settings of the laboratory."""
    return page(
        request,
        "settings.html",
        laboratory=laboratory.shown(),
        event_kinds=list(EventKind),
        administers=who.role is Role.ADMINISTRATOR,
        ended_states=ENDED,
        roles=[role.name.lower() for role in Role],
    )


@router.get("/runs/{run_id}/designsafe")
@allowed(Role.VIEWER)
def designsafe(request: Request, run_id: str, runs: Runs) -> HTMLResponse:
    """The form of a data set for DesignSafe."""
    return page(request, "designsafe.html", run=runs.get(run_id), licences=LICENCES)
