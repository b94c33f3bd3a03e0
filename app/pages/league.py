"""The page of the league of compensators."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.league.dependency import Leagues
from app.league.endpoints import Case
from app.pages.errors import PageRoute
from app.pages.league_chart import delay_and_error, spreads
from app.pages.rendering import page
from rths_engine.league.table import Row
from rths_engine.parts import compensators

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)
_FIELDS = {kind.model_fields["kind"].default: kind.model_fields for kind in compensators.KINDS}


@router.get("/league")
@allowed(Role.VIEWER)
def league(request: Request, leagues: Leagues, case: Case = 1) -> HTMLResponse:
    """The page of the league of a partitioning case."""
    if leagues.shown(case) is None:
        return page(request, "league_unmeasured.html", 404, case=case, cases=leagues.cases())
    found = leagues.league(case)
    rows = found.league.rows
    return page(
        request,
        "league.html",
        found=found,
        league=found.league,
        criteria=found.criteria,
        settings=[_settings(row) for row in rows],
        scatter=delay_and_error(rows),
        strips=spreads(rows),
        other=found.other_program,
        significant=significant,
    )


def significant(value: float | None) -> str:
    """Three significant digits without an exponent, at most four decimals; a dash where there is no value."""
    if value is None:
        return "–"
    if abs(value) >= 100:
        return f"{value:.0f}"
    return f"{value:.{2 if abs(value) < 10 else 1}f}" if abs(value) >= 1 else f"{value:z.3f}"


def _settings(row: Row) -> list[tuple[str, str]]:
    """Label and shown value of each setting of a row's compensator."""
    found: list[tuple[str, str]] = []
    for name, field in _FIELDS.get(row.kind, {}).items():
        value, extra = row.settings.get(name), field.json_schema_extra
        if name == "kind" or not isinstance(extra, dict):
            continue
        found.append((field.title or name, _shown(value, extra)))
    return found


def _shown(value: Any, extra: dict[str, Any]) -> str:
    if not isinstance(value, int | float) or isinstance(value, bool):
        return "–" if value is None else str(value)
    unit = extra.get("shown_label", "")
    return f"{value / extra.get('factor', 1.0):.4g} {unit}".rstrip()
