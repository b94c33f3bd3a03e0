"""Pages of tests: shells whose modules use the REST API."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.config import MEGABYTE
from app.dependencies import Configured
from app.pages.errors import PageRoute, error_page
from app.pages.rendering import page
from app.runs.dependency import Runs

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/queue")
@allowed(Role.VIEWER)
def queue(request: Request) -> HTMLResponse:
    """The page of the queue."""
    return page(request, "queue.html")


@router.get("/new")
@allowed(Role.VIEWER)
def new(request: Request, configured: Configured) -> HTMLResponse:
    """The page of a new test."""
    return page(request, "new.html", limit_mb=configured.upload_limit // MEGABYTE)


@router.get("/runs")
@allowed(Role.VIEWER)
def listed(request: Request, number: Annotated[int, Query(alias="page", ge=1, le=10**6)] = 1) -> HTMLResponse:
    """The run table. Its modules read the address, which holds columns, filter and order."""
    return page(request, "runs.html")


@router.get("/runs/{run_id}")
@allowed(Role.VIEWER)
def run(request: Request, run_id: str, runs: Runs) -> HTMLResponse:
    """The page of a run."""
    return page(request, "run.html", run=runs.get(run_id))


@router.get("/{path:page}")
@allowed(Role.VIEWER)
def missing(request: Request, path: str) -> HTMLResponse:
    """The page for an unknown address."""
    return error_page(request, 404, "Not found", f"The page /{path} does not exist.")
