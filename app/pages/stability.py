"""The page of the predicted stability of a run or a template."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse, RedirectResponse, Response

from app.access import Role, allowed
from app.pages.errors import PageRoute
from app.pages.rendering import plotted
from app.plans.dependency import Plans
from app.problems import NotFound
from app.runs.dependency import Runs

FIRST = "table3-04"

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/stability")
@allowed(Role.VIEWER)
def first(request: Request, plans: Plans, draft: str | None = None) -> Response:
    """The stability of the draft that the page New test keeps in the browser; without `draft`, that of the first template."""
    if draft is None:
        return RedirectResponse(f"/stability/{FIRST}")
    return plotted(request, "stability.html", name="", source="", templates=plans.templates(), known=False)


@router.get("/stability/{name}")
@allowed(Role.VIEWER)
def stability(request: Request, name: str, plans: Plans, runs: Runs) -> HTMLResponse:
    """The stability of a template or of a run; `name` is the template's name or the run's id."""
    templates = plans.templates()
    known = name in {template["name"] for template in templates}
    source = f"/templates/{name}" if known else f"/runs/{name}"
    if not known:
        try:
            runs.get(name)
        except NotFound:
            raise NotFound(f"There is no run or template {name}.") from None
    return plotted(request, "stability.html", name=name, source=source, templates=templates, known=known)
