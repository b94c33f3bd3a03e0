"""REST endpoints of runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query
from fastapi.responses import FileResponse, PlainTextResponse, Response
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.access import Role, Scope, Who, allowed
from app.calculations.answer import Calculated, CalculatedFile, Made
from app.calculations.bound import Bound
from app.config import Settings
from app.dependencies import Configured
from app.jobs.states import State
from app.openapi import file, told
from app.runs.dependency import Runs
from app.runs.exports import csv_parts, measures_text, recording_path
from app.runs.repository import Filter, Page
from app.runs.schemas import Asking, RunDetail, RunList, RunOut, Submission, Submitted
from app.runs.service import RunService
from app.times import InUtc
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning import plan_yaml

router = APIRouter(prefix="/api/v1", tags=["runs"])
CSV = Bound("CSV file", seconds=300, megabytes=2000, mend="download the recording as HDF5", long=True)
YAML = Bound("YAML of the plan", seconds=20, megabytes=2000, mend="read the plan as JSON")


class Wanted(BaseModel):
    """Filter, order and page of a list of runs. An empty parameter is ignored; a time without a time zone is UTC."""

    model_config = ConfigDict(extra="forbid")

    state: list[State] = []
    q: str = Field("", max_length=200)
    submitted_by: str = Field("", max_length=80)
    template: str = Field("", max_length=80)
    since: InUtc | None = None
    until: InUtc | None = None
    sort: str = Field("number", max_length=40)
    order: str = Field("desc", pattern="^(asc|desc)$")
    limit: int = Field(50, ge=1, le=500)
    offset: int = Field(0, ge=0, le=10**9)

    @model_validator(mode="before")
    @classmethod
    def _given(cls, query: dict[str, Any]) -> dict[str, Any]:
        return {name: value for name, value in query.items() if value not in ("", [""])}

    def filter(self) -> Filter:
        return Filter(tuple(self.state), self.q, self.submitted_by, self.template, self.since, self.until)

    def page(self) -> Page:
        return Page(self.sort, self.order == "desc", self.limit, self.offset)


@router.post("/runs", status_code=201)
@allowed(Role.OPERATOR, Scope.SUBMIT, Scope.OPERATE)
def submit(body: Annotated[Submission, Body()], runs: Runs, who: Who) -> Submitted:
    """Queue one plan (`plan`) or several plans (`plans`). If one plan has an error, none is queued.

    An operator, or an API token without the scope `submit`, queues plans of the library only: `library` names a version that is
    not archived, and the whole plan is that version, its pace and name included.
    """
    if (body.plan is None) == (body.plans is None):
        raise PlanError(Issue("plan", "needs either one plan as 'plan' or a list of plans as 'plans'"))
    if body.plans is None:
        plans, prefix = [body.plan], ""
    else:
        plans, prefix = body.plans, "plans.{}"
    as_kept = not who.queues_any_plan
    stored = runs.submit(plans, body.submitted_by, prefix, body.library, body.rig, body.priority, as_kept)
    return Submitted(runs=[RunOut.of(run) for run in stored])


@router.get("/runs")
@allowed(Role.VIEWER)
def listed(wanted: Annotated[Wanted, Query()], runs: Runs) -> RunList:
    """List runs by filter, order and page. `sort` is a column, or a measure and a station number: `mte_mm:1`."""
    found, total = runs.listed(wanted.filter(), wanted.page())
    return RunList(runs=[RunOut.of(run) for run in found], total=total)


@router.get("/runs/{run_id}")
@allowed(Role.VIEWER)
def one(run_id: str, runs: Runs) -> RunDetail:
    """A run with its plan and its measures."""
    run = runs.get(run_id)
    return RunDetail.of(run, runs.undo_until(run))


@router.post("/runs/{run_id}/cancel")
@allowed(Role.OPERATOR)
def cancel(run_id: str, runs: Runs, person: Asking) -> RunOut:
    """Cancel a test. A queued test ends now; a running test stops within a second, and the samples so far are stored.

    A test that waits for approval is withdrawn, by the person who submitted it only.
    """
    return RunOut.of(runs.cancel(run_id, person.by))


@router.post("/runs/{run_id}/undo-cancel")
@allowed(Role.OPERATOR)
def undo_cancel(run_id: str, runs: Runs, person: Asking) -> RunOut:
    """Undo the cancel of a queued test within 10 minutes: it is back at its place in the queue.

    Where another person approves submissions and nobody has approved this test, it waits for approval.
    """
    return RunOut.of(runs.undo_cancel(run_id, person.by))


@router.post("/runs/{run_id}/retry", status_code=201)
@allowed(Role.OPERATOR)
def retry(run_id: str, runs: Runs, person: Asking) -> RunOut:
    """Queue the plan of a run that has ended again, on the same rig. The new run names the first one in `retry_of`."""
    return RunOut.of(runs.retry(run_id, person.by))


@router.get("/runs/{run_id}/recording.h5", response_class=FileResponse, responses=file("application/x-hdf5") | told(409))
@allowed(Role.VIEWER)
def recording_hdf5(run_id: str, runs: Runs, configured: Configured) -> FileResponse:
    """The recording of a run as HDF5."""
    run = runs.get(run_id)
    headers = {"ETag": f'"{run.recording_sha256}"'}
    return FileResponse(
        recording_path(run, configured), media_type="application/x-hdf5", filename=f"{run.id}.h5", headers=headers
    )


@router.get("/runs/{run_id}/recording.csv", response_class=FileResponse, responses=file("text/csv") | told(409, 422, 503))
@allowed(Role.VIEWER)
def recording_csv(run_id: str, runs: Runs, configured: Configured) -> Response:
    """The recording of a run as CSV."""
    return CalculatedFile(CSV, f"{run_id}.csv", "text/csv", _write_csv, runs, run_id, configured)


@router.get("/runs/{run_id}/measures.csv", response_class=PlainTextResponse, responses=file("text/csv") | told(409))
@allowed(Role.VIEWER)
def measures_csv(run_id: str, runs: Runs) -> PlainTextResponse:
    """The measures of a run as CSV. Each row has station or floor, key, label, value and unit."""
    run = runs.get(run_id)
    headers = {"Content-Disposition": f'attachment; filename="{run.id}-measures.csv"'}
    return PlainTextResponse(measures_text(run), media_type="text/csv", headers=headers)


@router.get("/runs/{run_id}/plan.yaml", response_class=Response, responses=file("application/yaml") | told(422, 503))
@allowed(Role.VIEWER)
def plan_text(run_id: str, runs: Runs) -> Response:
    """The plan of a run as YAML."""
    return Calculated(YAML, _plan_text, runs, run_id)


def _plan_text(runs: RunService, run_id: str) -> Made:
    run = runs.get(run_id)
    headers = {"Content-Disposition": f'attachment; filename="{run.id}.yaml"'}
    return Made(plan_yaml.write(runs.plan_of(run)).encode(), "application/yaml", headers)


def _write_csv(path: Path, runs: RunService, run_id: str, configured: Settings) -> None:
    with path.open("wb") as file:
        file.writelines(csv_parts(recording_path(runs.get(run_id), configured)))
