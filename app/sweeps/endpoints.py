"""REST endpoints of sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Query
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated, Made
from app.openapi import PlanData, told
from app.runs.schemas import Asking, RunOut
from app.sweeps import exports
from app.sweeps.dependency import Sweeps
from app.sweeps.preview import ANALYSIS, EXAMINATION
from app.sweeps.schemas import (
    PlanField,
    PlanFields,
    PointOut,
    PreviewOut,
    ResultsOut,
    SweepData,
    SweepDetail,
    SweepList,
    SweepOut,
    SweepSubmission,
)
from app.sweeps.service import SweepService
from app.sweeps.shown import inputs_of
from rths_engine.foundation.part import validated
from rths_engine.planning.plan import Plan
from rths_engine.sweeps.definition import Definition
from rths_engine.sweeps.places import numbers
from rths_engine.sweeps.table import POINT

router = APIRouter(prefix="/api/v1/sweeps", tags=["sweeps"])
Status = Literal["completed", "tripped", "invalid", "failed"]
FILES: dict[int | str, dict[str, Any]] = {
    200: {"content": {"text/csv": {"schema": {"type": "string"}}, exports.ARROW: {"schema": {}}}}
}


@router.post("/preview")
@allowed(Role.VIEWER)
def preview(sweep: Annotated[SweepData, Body()], sweeps: Sweeps) -> PreviewOut:
    """Count the points of a sweep and predict their stability and computing time, without queueing it."""
    return sweeps.preview(sweep)


@router.get("/schema")
@allowed(Role.VIEWER)
def schema() -> dict[str, Any]:
    """JSON Schema of a sweep, `rths-sweep/1`."""
    return Definition.model_json_schema()


@router.post("/fields", response_model=PlanFields, responses=told(503))
@allowed(Role.VIEWER)
def fields(plan: Annotated[PlanData, Body()]) -> Response:
    """List the numbers of a plan that a sweep can vary, each with path, label, unit, value and bounds."""
    return Calculated(EXAMINATION, _fields, plan)


@router.post("", status_code=201)
@allowed(Role.ENGINEER)
def submit(body: Annotated[SweepSubmission, Body()], sweeps: Sweeps) -> SweepOut:
    """Queue a sweep. If its definition has an error, or no examined point is valid, nothing is queued."""
    sweep = sweeps.submit(body.sweep, body.submitted_by)
    return exports.out(sweep, sweeps.standing(sweep))


@router.get("")
@allowed(Role.VIEWER)
def listed(
    sweeps: Sweeps,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> SweepList:
    """List sweeps, the newest first."""
    found, total = sweeps.listed(limit, offset)
    return SweepList(sweeps=[exports.out(*one) for one in found], total=total)


@router.get("/{sweep_id}")
@allowed(Role.VIEWER)
def one(sweep_id: str, sweeps: Sweeps) -> SweepDetail:
    """A sweep with its progress, its definition and the declarations of its columns."""
    sweep = sweeps.get(sweep_id)
    return exports.detail(sweep, sweeps.standing(sweep))


@router.get("/{sweep_id}/results", response_model=ResultsOut, responses=FILES | told(503))
@allowed(Role.VIEWER)
def results(
    sweep_id: str,
    sweeps: Sweeps,
    format: Literal["json", "csv", "arrow"] = "json",
    status: Annotated[list[Status], Query()] = [],  # noqa: B006
    sort: Annotated[str, Query(max_length=400)] = POINT,
    order: Literal["asc", "desc"] = "asc",
    limit: Annotated[int | None, Query(ge=1, le=100_000)] = None,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> Response:
    """Results so far in columns, in the units shown: of every point with a result, or a page of them.

    `sort` is the key of a column, or `point`; points without a value come last. `status` leaves only these points.
    """
    return Calculated(ANALYSIS, _results, sweeps, sweep_id, sort, order == "desc", status, format, offset, limit)


@router.post("/{sweep_id}/cancel")
@allowed(Role.ENGINEER)
def cancel(sweep_id: str, sweeps: Sweeps, person: Asking) -> SweepOut:
    """Cancel a sweep. It stops within a second; the points done are kept, and `resume` executes the others.

    A sweep that waits for approval is withdrawn, by the person who submitted it only.
    """
    sweep = sweeps.cancel(sweep_id, person.by)
    return exports.out(sweep, sweeps.standing(sweep))


@router.post("/{sweep_id}/resume")
@allowed(Role.ENGINEER)
def resume(sweep_id: str, sweeps: Sweeps, person: Asking) -> SweepOut:
    """Queue the points of a cancelled or failed sweep that have no result."""
    sweep = sweeps.resume(sweep_id, person.by)
    return exports.out(sweep, sweeps.standing(sweep))


@router.delete("/{sweep_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(sweep_id: str, sweeps: Sweeps) -> None:
    """Delete a sweep that has ended, with its results."""
    sweeps.remove(sweep_id)


@router.get("/{sweep_id}/points/{point}", responses=told(422))
@allowed(Role.VIEWER)
def point(sweep_id: str, point: int, sweeps: Sweeps) -> PointOut:
    """One point of a sweep, counted from 1: its inputs, results and plan."""
    design, table = sweeps.point(sweeps.get(sweep_id), point)
    values = {key: column[0] for key, column in table.as_dict().items()} if len(table.points) else None
    return PointOut(
        point=point,
        inputs=inputs_of(design, point - 1),
        results=values,
        reason=values["reason"] if values else None,
        plan=design.named(point - 1),
    )


@router.post("/{sweep_id}/points/{point}/run", status_code=201)
@allowed(Role.ENGINEER)
def run(sweep_id: str, point: int, sweeps: Sweeps, person: Asking) -> RunOut:
    """Queue the plan of a point as an ordinary run, whose recording has the full histories."""
    return RunOut.of(sweeps.run_point(sweep_id, point, person.by))


def _fields(plan: Any) -> PlanFields:
    return PlanFields(fields=[PlanField(**one.as_dict()) for one in numbers(validated(Plan, plan))])


def _results(
    sweeps: SweepService,
    sweep_id: str,
    sort: str,
    descending: bool,
    status: Sequence[str],
    form: str,
    offset: int,
    limit: int | None,
) -> Made:
    sweep = sweeps.get(sweep_id)
    return exports.results(sweeps.table(sweep, sort, descending, status), sweep, form, offset, limit)
