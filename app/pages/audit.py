"""The page of the audit log."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, Scope, allowed
from app.pages.errors import PageRoute
from app.pages.rendering import page

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/audit")
@allowed(Role.ENGINEER, Scope.READ)
def audit(request: Request) -> HTMLResponse:
    """The audit log, newest entry first."""
    return page(request, "audit.html")
