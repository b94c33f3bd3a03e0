"""The pages of comparisons: a comparison, and the choice of what to compare."""

from __future__ import annotations

from contextlib import suppress
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse, RedirectResponse, Response

from app.access import Role, allowed
from app.calculations.answer import Calculating
from app.compare.dependency import Comparisons
from app.compare.endpoints import COMPARISON
from app.compare.items import MOST, Ref, refs
from app.compare.schemas import ComparisonOut, MeasureOut
from app.compare.service import CompareService, address
from app.pages.errors import PageRoute
from app.pages.rendering import page
from app.problems import Conflict, NotFound
from app.reports.digits import NONE, short
from rths_engine.foundation.errors import RecordingError, RthsError

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)
Items = Annotated[list[str], Query()]
NOTHING: list[str] = []
IN_PAGE = {"ref", "kind", "label", "name", "start_s", "duration_s"}  # of an item, for the scripts


@router.get("/compare")
@allowed(Role.VIEWER)
def compare(
    request: Request,
    comparisons: Comparisons,
    calculate: Calculating,
    items: Items = NOTHING,
    reference: str = "",
    q: str = "",
    choose: bool = False,
) -> Response:
    """The page of a comparison; without two items, with `choose`, or where they are refused, the choice of items."""
    try:
        given = refs(items)
        if len(given) < 2 or choose:
            return _choice(request, comparisons, given, q)
        found = calculate(COMPARISON, comparisons.compare, items, reference)
    except (RthsError, NotFound, Conflict) as error:
        return _choice(request, comparisons, _readable(items), q, error)
    if len(items) > 1:
        return RedirectResponse(address([str(one) for one in given], reference))
    return page(request, "compare.html", found=found, **_shown(found))


@router.get("/compare/previous/{run_id}")
@allowed(Role.VIEWER)
def previous(request: Request, run_id: str, comparisons: Comparisons) -> Response:
    """Redirect to the comparison of a run with the run before it, or offer what to compare it with."""
    found = comparisons.previous(run_id)
    if found.address:
        return RedirectResponse(found.address)
    missing = NotFound("There is no earlier run of the same template or name that has a recording. Choose another run.")
    return _choice(request, comparisons, [Ref("run", run_id)], "", missing, status=200)


def _readable(items: list[str]) -> list[Ref]:
    try:
        return refs(items)
    except RthsError:
        return []


def _choice(
    request: Request, comparisons: CompareService, given: list[Ref], q: str, error: Exception | None = None, status: int = 0
) -> HTMLResponse:
    chosen = []
    for ref in given:
        with suppress(NotFound):
            chosen.append(comparisons.candidate(ref))
    names = {one.ref for one in chosen}
    offered = [one for one in comparisons.candidates(q) if one.ref not in names]
    status = status or _status(error)
    about: dict[str, Any] = {"chosen": chosen, "offered": offered, "q": q, "problem": error and str(error), "most": MOST}
    return page(request, "compare_choose.html", status, **about)


def _status(error: Exception | None) -> int:
    if error is None:
        return 200
    if isinstance(error, NotFound):
        return 404
    return 409 if isinstance(error, Conflict | RecordingError) else 422


def _shown(found: ComparisonOut) -> dict[str, Any]:
    """What the template shows besides the comparison itself."""
    names = [one.ref for one in found.items]
    places: dict[str, list[MeasureOut]] = {}
    for row in found.measures:
        places.setdefault(row.where, []).append(row)
    return {
        "refs": ",".join(names),
        "links": [address(names, one) for one in names],
        "places": places,
        "stations": sorted({station.number for one in found.items for station in one.stations}),
        "floors": max(one.floors for one in found.items),
        "counted": _counted(found),
        "items_json": [one.model_dump(mode="json", include=IN_PAGE) for one in found.items],
        "roles_json": [one.model_dump(mode="json") for one in found.roles],
        "digits": digits,
        "signed": signed,
    }


def _counted(found: ComparisonOut) -> str:
    """`2 runs and 1 recording`."""
    counts = {kind: sum(one.kind == kind for one in found.items) for kind in ("run", "recording")}
    return " and ".join(f"{count} {kind}{'s' if count > 1 else ''}" for kind, count in counts.items() if count)


def digits(value: float | None) -> str:
    """Three significant digits; a dash where there is no value."""
    if value is None:
        return NONE
    text = f"{value:#.3g}".removesuffix(".") if value else "0"
    return (short(value, 3) if "e" in text else text).replace("-", "−")


def signed(value: float | None) -> str:
    """Three significant digits with the sign."""
    return NONE if value is None else f"{'+' if value > 0 else ''}{digits(value)}"
