"""The wall display: a page without controls for a second screen."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.laboratory.dependency import OneLaboratory
from app.pages.errors import PageRoute
from app.pages.rendering import page
from app.runs.dependency import Runs

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/wall")
@allowed(Role.VIEWER)
def wall(request: Request, laboratory: OneLaboratory, runs: Runs, run: str = "") -> HTMLResponse:
    """What runs now, or one run; between tests the last one. The address can stay on a second screen."""
    if run:
        runs.get(run)
    return page(request, "wall.html", laboratory=laboratory.shown().name, run_id=run)
