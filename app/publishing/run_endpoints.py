"""REST endpoints of the reports and data packages of runs."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import FileResponse, HTMLResponse, Response
from pydantic import BaseModel, Field

from app.access import Role, allowed
from app.openapi import Issue as IssueOut
from app.openapi import file, told
from app.publishing.answers import PDF, as_file, as_html, as_pdf
from app.publishing.dependency import OfRuns
from app.publishing.designsafe.metadata import Metadata

router = APIRouter(prefix="/api/v1/runs/{run_id}", tags=["reports"])
MATLAB, ZIP = "application/x-matlab-data", "application/zip"


class Completeness(BaseModel):
    """What a data set for DesignSafe still needs; nothing where it is complete."""

    missing: list[IssueOut] = Field(description="required entities and fields that are missing, each with how to mend it")


@router.get("/report.html", response_class=HTMLResponse, responses=told(409, 422))
@allowed(Role.VIEWER)
def report_html(run_id: str, reports: OfRuns, interactive: bool = False) -> HTMLResponse:
    """The report of a run as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return as_html(reports.of(run_id).document, interactive)


@router.get("/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422))
@allowed(Role.VIEWER)
def report_pdf(run_id: str, reports: OfRuns) -> Response:
    """The report of a run as PDF."""
    return as_pdf(reports.of(run_id).document, run_id)


@router.get("/recording.mat", response_class=FileResponse, responses=file(MATLAB) | told(409, 422))
@allowed(Role.VIEWER)
def recording_matlab(run_id: str, reports: OfRuns) -> FileResponse:
    """The recording of a run as a MATLAB file: a struct for each channel with values (SI), unit and label."""
    return as_file(reports.of(run_id).write_matlab, f"{run_id}.mat", MATLAB)


@router.post("/designsafe/check", responses=told(409))
@allowed(Role.VIEWER)
def check(run_id: str, reports: OfRuns, given: Annotated[Metadata, Body()]) -> Completeness:
    """List every required entity and field that a data set for DesignSafe still needs, with how to mend it."""
    issues = reports.of(run_id).missing(given)
    return Completeness(missing=[IssueOut.model_validate(one.as_dict()) for one in issues])


@router.post("/designsafe.zip", response_class=FileResponse, responses=file(ZIP) | told(409))
@allowed(Role.VIEWER)
def designsafe(run_id: str, reports: OfRuns, given: Annotated[Metadata, Body()]) -> FileResponse:
    """A data set for DesignSafe's Data Depot as a ZIP archive. It is refused while a required entity or field is missing."""
    published = reports.of(run_id)
    return as_file(lambda path: published.write_designsafe(path, given), f"{run_id}-designsafe.zip", ZIP)
