"""The page of the settings: what is stored once for the whole laboratory."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.events.tables import EventKind
from app.laboratory.dependency import OneLaboratory
from app.pages.errors import PageRoute
from app.pages.rendering import page

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/settings")
def settings(request: Request, laboratory: OneLaboratory) -> HTMLResponse:
    """The settings of the laboratory."""
    return page(request, "settings.html", laboratory=laboratory.shown(), event_kinds=list(EventKind))
