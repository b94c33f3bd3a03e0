"""The pages of the library of plans: the list with a person's drafts, and one plan with its versions and runs."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.config import MEGABYTE
from app.dependencies import Configured
from app.library.dependency import KeptPlans
from app.pages.errors import PageRoute
from app.pages.rendering import page

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/plans")
@allowed(Role.VIEWER)
def listed(request: Request, configured: Configured) -> HTMLResponse:
    """The page of all plans and of this person's drafts."""
    return page(request, "plans.html", limit_mb=configured.upload_limit // MEGABYTE)


@router.get("/plans/{plan_id}")
@allowed(Role.VIEWER)
def one(request: Request, plan_id: str, plans: KeptPlans) -> HTMLResponse:
    """The page of a plan in the library."""
    return page(request, "plan.html", plan=plans.get(plan_id))
