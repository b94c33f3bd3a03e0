"""REST endpoints of comparisons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated, Made
from app.calculations.bound import Bound
from app.compare.dependency import Comparisons
from app.compare.schemas import CandidateOut, ComparisonOut, PreviousOut
from app.compare.service import CompareService
from app.compare.signals import Shown
from app.openapi import file, told

router = APIRouter(prefix="/api/v1/compare", tags=["compare"])
COMPARISON = Bound("comparison", seconds=60, megabytes=4000, mend="compare fewer or shorter recordings")
Items = Annotated[
    list[str], Query(description="2 to 20 items, `run:ID` or `recording:ID`, with commas or repeated", max_length=100)
]
Seconds = Annotated[float | None, Query(allow_inf_nan=False)]


@router.get("", response_model=ComparisonOut, responses=told(404, 409, 503))
@allowed(Role.VIEWER)
def compare(items: Items, comparisons: Comparisons, reference: Annotated[str, Query(max_length=80)] = "") -> Response:
    """Compare runs and imported recordings: the plan fields that differ, and measures with differences to the reference.

    The reference is the first item, or the one named by `reference`. `notes` says in words what an overlay of curves does not
    show, such as excitations that differ.
    """
    return Calculated(COMPARISON, comparisons.compare, items, reference)


@router.get("/signals", response_class=Response, responses=file("application/octet-stream") | told(404, 409, 503))
@allowed(Role.VIEWER)
def signals(
    items: Items,
    comparisons: Comparisons,
    station: Annotated[int, Query(ge=1, le=1000)] = 1,
    floor: Annotated[int, Query(ge=1, le=10_000)] = 1,
    from_s: Seconds = None,
    to_s: Seconds = None,
    points: Annotated[int, Query(ge=10, le=4000)] = 800,
    from_start: bool = False,
) -> Response:
    """The signals of one station and one floor of all items, decimated to their extremes, as binary data.

    The body has a uint32 length, a JSON head of that length and little-endian float32 values. The head lists the series in the
    order of their values: `item`, `role`, `form`, `start_s`, `step_s` and `count`. `form` is `envelope` (smallest and largest
    value of at most `points` equal parts) or `samples` (every n-th sample, for loops). With `from_start`, the times of an
    imported recording count from its first sample.
    """
    return Calculated(COMPARISON, _signals, comparisons, items, Shown(station, floor, from_s, to_s, points, from_start))


def _signals(comparisons: CompareService, items: Sequence[str], shown: Shown) -> Made:
    return Made(comparisons.signals(items, shown), "application/octet-stream")


@router.get("/candidates")
@allowed(Role.VIEWER)
def candidates(comparisons: Comparisons, q: Annotated[str, Query(max_length=200)] = "") -> dict[str, list[CandidateOut]]:
    """List the latest runs with a recording and the latest imported recordings that can be compared."""
    return {"candidates": comparisons.candidates(q)}


@router.get("/previous/{run_id}")
@allowed(Role.VIEWER)
def previous(run_id: str, comparisons: Comparisons) -> PreviousOut:
    """The run before a run of the same template or of the same name, and the page that compares both."""
    return comparisons.previous(run_id)
