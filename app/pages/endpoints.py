"""The web pages. Lab and Runs are rendered on the server; Queue, New test and Run are shells whose modules use the REST API."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.config import MEGABYTE
from app.dependencies import Configured
from app.jobs.states import State
from app.live.hub import Hub
from app.models import Run
from app.pages.errors import PageRoute, error_page
from app.pages.rendering import page
from app.pages.run_list import LIMIT, RunFilter
from app.plans.dependency import Plans
from app.queue.dependency import Queued
from app.runs.dependency import Runs
from app.runs.repository import Filter, Page
from rths_engine.foundation.errors import RthsError

QUEUED_SHOWN = 20
RECENT_SHOWN = 12

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/")
def lab(request: Request, runs: Runs, queued: Queued) -> HTMLResponse:
    """The Lab page: the queue, the running tests and the recent runs."""
    return page(request, "lab.html", **_lab(request, runs, queued))


@router.get("/lab")
def lab_now(request: Request, runs: Runs, queued: Queued) -> HTMLResponse:
    """The changing part of the Lab page."""
    return page(request, "lab_now.html", **_lab(request, runs, queued))


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


def _progress(hub: Hub, run_id: str) -> dict[str, Any]:
    """The worker's last progress report on a running test, empty before the first report."""
    live = hub.runs.get(run_id)
    return (live.progress if live else None) or {}


def _lab(request: Request, runs: Runs, queued: Queued) -> dict[str, Any]:
    oldest = Page(sort="number", descending=False, limit=QUEUED_SHOWN)
    running, _ = runs.listed(Filter(states=(State.RUNNING,)), oldest)
    ended = tuple(state for state in State if state.ended)
    recent, _ = runs.listed(Filter(states=ended), Page(sort="finished_at", limit=RECENT_SHOWN))
    queue = queued.state(QUEUED_SHOWN)
    lists = {"running": running, "queued": queue.waiting, "queued_total": queue.queued, "recent": recent}
    live = {run.id: _progress(request.app.state.hub, run.id) for run in running}
    return {**lists, "live": live, "queue": queue, "worker_alive": queue.worker_alive}
