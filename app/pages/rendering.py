"""Pages from templates: the filters of the templates, and headers that restrict a page to this service's own files."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from fastapi import Request
from fastapi.responses import HTMLResponse
from fastapi.templating import Jinja2Templates
from jinja2 import Undefined

from app import disk, headers
from app.access import PERSON
from app.full import FIX
from app.models import Run
from rths_engine.results.measure import Measure
from rths_engine.results.measures import MEASURES

FRONTEND = Path(__file__).parents[2] / "frontend"
HEADERS = headers.EVERY | {headers.POLICY: headers.PAGE, "Cache-Control": "no-cache"}
PLOTLY = {headers.POLICY: headers.INLINE_STYLES}


def fixed(value: Any, decimals: int = 1) -> str:
    """A number with fixed decimals; a dash if there is no value."""
    return "–" if value is None or isinstance(value, Undefined) else f"{value:z.{decimals}f}"


def brief(value: float | None) -> str:
    """A number with four significant digits; a dash if there is no value."""
    return "–" if value is None else f"{value:.4g}"


def ago(moment: datetime | None) -> str:
    """The time since a moment in its two largest units: `3 min 20 s`."""
    if moment is None:
        return "–"
    return _lasting(max(0, int((datetime.now(UTC) - moment).total_seconds())))


def hence(moment: datetime | None) -> str:
    """The time until a moment: `in 3 min 20 s`, or `now`."""
    if moment is None:
        return "–"
    seconds = int((moment - datetime.now(UTC)).total_seconds())
    return f"in {_lasting(seconds)}" if seconds > 0 else "now"


def _lasting(seconds: int) -> str:
    """A duration in its two largest units."""
    days, rest = divmod(seconds, 86_400)
    hours, rest = divmod(rest, 3600)
    minutes, seconds = divmod(rest, 60)
    if days:
        return f"{days} d {hours} h"
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def clock(moment: datetime | None) -> str:
    """Date and time in UTC."""
    return "–" if moment is None else moment.astimezone(UTC).strftime("%Y-%m-%d %H:%M")


def kind(test: str) -> str:
    """The short name of a kind of test."""
    return {"structure": "structure alone"}.get(test, test)


def pace(factor: float | None) -> str:
    """The planned pace in words; None is a test without one."""
    if factor is None:
        return "as fast as possible"
    return "real time" if factor == 1 else f"{factor:g} × real time"


def listed_measures() -> list[Measure]:
    """The measures that the lists of runs show."""
    return [one for one in MEASURES if one.listed]


def measured(run: Run, one: Measure) -> str:
    """A measure of a run in a list: the value of each station, the largest of the floors, or the value of the whole test."""
    if one.scope == "station":
        return " / ".join(one.text(station.measure(one.key)) for station in run.stations) or "–"
    value = getattr(run, one.key)
    if one.scope == "floor":
        value = max((peak for peak in value or [] if peak is not None), default=None)
    return one.text(value)


def belongs(path: str, entry: str) -> bool:
    """Whether a page belongs to an entry of the menu: it stands below its address, or is linked from it."""
    return (entry != "/" and path.startswith(f"{entry}/")) or (path, entry) == ("/league", "/table4")


def low_disk(request: Request) -> str:
    """What every page says while the disk is below its reserve; empty otherwise."""
    found = disk.space(request.app.state.settings)
    return f"{found.sentence}. New tests and uploads are refused; everything else goes on. {FIX}." if found.low else ""


templates = Jinja2Templates(directory=FRONTEND / "templates")
templates.env.filters |= {
    "fixed": fixed,
    "brief": brief,
    "ago": ago,
    "hence": hence,
    "clock": clock,
    "kind": kind,
    "pace": pace,
    "measured": measured,
}
templates.env.globals |= {"listed_measures": listed_measures, "belongs": belongs, "low_disk": low_disk}


def page(request: Request, template: str, status: int = 200, **context: Any) -> HTMLResponse:
    """A template as a response with the headers of every page."""
    context.setdefault("who", request.scope.get(PERSON))
    return templates.TemplateResponse(request, template, context, status_code=status, headers=HEADERS)


def plotted(request: Request, template: str, **context: Any) -> HTMLResponse:
    """A page with Plotly plots."""
    shown = page(request, template, **context)
    shown.headers.update(PLOTLY)
    return shown
