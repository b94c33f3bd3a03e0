"""Pages of tests. Runs is rendered on the server; Queue, New test and Run are shells whose modules use the REST API."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.config import MEGABYTE
from app.dependencies import Configured
from app.jobs.states import State
from app.models import Run
from app.pages.errors import PageRoute, error_page
from app.pages.rendering import page
from app.pages.run_list import LIMIT, RunFilter
from app.plans.dependency import Plans
from app.runs.dependency import Runs
from rths_engine.foundation.errors import RthsError

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/queue")
def queue(request: Request) -> HTMLResponse:
    """The page of the queue."""
    return page(request, "queue.html")


@router.get("/new")
def new(request: Request, configured: Configured) -> HTMLResponse:
    """The page of a new test."""
    return page(request, "new.html", limit_mb=configured.upload_limit // MEGABYTE)


@router.get("/runs")
def listed(request: Request, runs: Runs, plans: Plans, wanted: Annotated[RunFilter, Query()]) -> HTMLResponse:
    """The page of all runs, filtered and sorted."""
    found: list[Run] = []
    total, problem = 0, None
    try:
        found, total = runs.listed(wanted.filter(), wanted.part())
    except RthsError as error:
        problem = str(error)
    offered = {"states": list(State), "templates": plans.templates()}
    shown = {"runs": found, "total": total, "first": LIMIT * (wanted.number - 1) + 1, "problem": problem}
    return page(request, "runs.html", 422 if problem else 200, wanted=wanted, **offered, **shown)


@router.get("/runs/{run_id}")
def run(request: Request, run_id: str, runs: Runs) -> HTMLResponse:
    """The page of a run."""
    return page(request, "run.html", run=runs.get(run_id))


@router.get("/{path:page}")
def missing(request: Request, path: str) -> HTMLResponse:
    """The page for an unknown address."""
    return error_page(request, 404, "Not found", f"The page /{path} does not exist.")
