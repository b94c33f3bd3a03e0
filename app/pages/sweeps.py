"""The pages of sweeps: the list, the form of a new sweep, and one sweep with its progress and results."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.library.dependency import KeptPlans
from app.library.repository import Wanted
from app.pages.errors import PageRoute
from app.pages.rendering import page, plotted
from app.plans.dependency import Plans
from app.sweeps.dependency import Sweeps
from app.sweeps.exports import detail, out
from rths_engine.sweeps.definition import METHODS

LIMIT = 50
OFFERED = 200  # plans of the library

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/sweeps")
@allowed(Role.VIEWER)
def listed(request: Request, sweeps: Sweeps, number: Annotated[int, Query(alias="page", ge=1, le=10**6)] = 1) -> HTMLResponse:
    """The list of sweeps, the newest first."""
    found, total = sweeps.listed(LIMIT, LIMIT * (number - 1))
    part: dict[str, Any] = {"total": total, "number": number, "first": LIMIT * (number - 1) + 1}
    return page(request, "sweeps.html", sweeps=[out(*one) for one in found], methods=METHODS, **part)


@router.get("/sweeps/new")
@allowed(Role.VIEWER)
def new(request: Request, plans: Plans, library: KeptPlans) -> HTMLResponse:
    """The form of a new sweep. The address names its base: `template`, `library`, `run` or an earlier sweep, `from`."""
    kept = library.listed(Wanted(limit=OFFERED)).plans
    offered: dict[str, Any] = {"templates": plans.templates(), "kept": kept, "methods": METHODS}
    return page(request, "sweep_new.html", **offered)


@router.get("/sweeps/{sweep_id}")
@allowed(Role.VIEWER)
def one(request: Request, sweep_id: str, sweeps: Sweeps) -> HTMLResponse:
    """The page of a sweep."""
    sweep = sweeps.get(sweep_id)
    found = detail(sweep, sweeps.standing(sweep))
    declared = found.model_dump(mode="json", exclude={"sweep"})
    return plotted(request, "sweep.html", sweep=found, method=METHODS[found.method], declared=declared)
