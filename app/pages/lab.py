"""The Lab page: what runs, what waits, what ended, what happened meanwhile, and a tour for the first visit."""

from __future__ import annotations

from collections import Counter
from typing import Any

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse, Response

from app.access import Role, SignedIn, Who, allowed
from app.control.dependency import Controlled
from app.control.schemas import ControlList
from app.control.service import Control
from app.demonstration import TEMPLATE
from app.dependencies import OneSession
from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs.states import State
from app.models import Run
from app.pages.errors import PageRoute
from app.pages.lab_cards import Card, card
from app.pages.parts import part
from app.pages.rendering import page
from app.queue.dependency import Queued
from app.runs.dependency import Runs
from app.runs.repository import Filter, Page
from app.runs.service import RunService
from app.times import InUtc

QUEUED_SHOWN = 5
RECENT_SHOWN = 8
NEWS_SHOWN = 6
WORTH_TELLING = tuple(kind for kind in EventKind if kind is not EventKind.STARTED)
ENDED = tuple(state for state in State if state.ended)

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/")
@allowed(Role.VIEWER)
def lab(request: Request, runs: Runs, queued: Queued, control: Controlled, who: Who) -> HTMLResponse:
    """The Lab page."""
    return page(request, "lab.html", control=_control(control, who), **_now(request, runs, queued))


@router.get("/lab")
@allowed(Role.VIEWER)
def lab_now(request: Request, runs: Runs, queued: Queued, control: Controlled, who: Who) -> Response:
    """The changing part of the Lab page."""
    return part(request, "lab_now.html", "/", lambda: {"control": _control(control, who), **_now(request, runs, queued)})


@router.get("/lab/since")
@allowed(Role.VIEWER)
def lab_since(request: Request, session: OneSession, moment: InUtc) -> Response:
    """What happened since a moment, the newest first."""

    def news() -> dict[str, Any]:
        events, total = EventLog(session).listed(since=moment, kinds=WORTH_TELLING, limit=500)
        counts = Counter(event.kind for event in events if event.about == "run")
        told = [(kind, counts[kind]) for kind in WORTH_TELLING if counts[kind]]
        return {"since": moment, "events": events[:NEWS_SHOWN], "counts": told, "more": total - NEWS_SHOWN}

    return part(request, "lab_since.html", "/", news)


def _control(control: Control, who: SignedIn) -> ControlList | None:
    """What the person drives; None without accounts, where the page does not know who the person is."""
    return None if who.how == "local" else control.shown(who.name, may_take_over=False)


def _now(request: Request, runs: Runs, queued: Queued) -> dict[str, Any]:
    queue = queued.state(QUEUED_SHOWN)
    recent, ended = runs.listed(Filter(states=ENDED), Page(sort="finished_at", limit=RECENT_SHOWN))
    return {"queue": queue, "cards": _cards(request, runs), "recent": recent, "ended": ended, "tour": _tour(runs)}


def _cards(request: Request, runs: RunService) -> list[Card]:
    running, _ = runs.listed(Filter(states=(State.RUNNING,)), Page(sort="number", descending=False))
    live = request.app.state.hub.runs
    return [card(run, runs.plan_of(run), live.get(run.id)) for run in running]


def _tour(runs: RunService) -> dict[str, Run | None]:
    """The newest demonstration, and the newest later run of the same name whose plan differs."""
    demonstrations, _ = runs.listed(Filter(template=TEMPLATE), Page(limit=1))
    if not demonstrations:
        return {"demonstration": None, "changed": None}
    demonstration = demonstrations[0]
    others, _ = runs.listed(Filter(), Page(limit=20))
    later = [run for run in others if run.number > demonstration.number and run.name == demonstration.name]
    changed = next((run for run in later if run.digest != demonstration.digest), None)
    return {"demonstration": demonstration, "changed": changed}
