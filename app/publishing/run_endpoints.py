"""REST endpoints of the reports and data packages of runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import FileResponse, HTMLResponse, Response
from pydantic import BaseModel, Field

from app.access import Role, allowed
from app.calculations.answer import Calculated, CalculatedFile, Made
from app.calculations.bound import Bound
from app.openapi import Issue as IssueOut
from app.openapi import file, told
from app.publishing.answers import PDF, REPORT, as_html, as_pdf
from app.publishing.dependency import OfRuns
from app.publishing.designsafe.metadata import Metadata
from app.publishing.runs import RunReports

router = APIRouter(prefix="/api/v1/runs/{run_id}", tags=["reports"])
PACKAGE = Bound("data package", seconds=120, megabytes=6000, mend="download the recording as HDF5", long=True)
MATLAB, ZIP = "application/x-matlab-data", "application/zip"


class Completeness(BaseModel):
    """What a data set for DesignSafe still needs; nothing where it is complete."""

    missing: list[IssueOut] = Field(description="required entities and fields that are missing, each with how to mend it")


@router.get("/report.html", response_class=HTMLResponse, responses=told(409, 422, 503))
@allowed(Role.VIEWER)
def report_html(run_id: str, reports: OfRuns, interactive: bool = False) -> Response:
    """The report of a run as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return Calculated(REPORT, _html, reports, run_id, interactive)


@router.get("/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422, 503))
@allowed(Role.VIEWER)
def report_pdf(run_id: str, reports: OfRuns) -> Response:
    """The report of a run as PDF."""
    return Calculated(REPORT, _pdf, reports, run_id)


@router.get("/recording.mat", response_class=FileResponse, responses=file(MATLAB) | told(409, 422, 503))
@allowed(Role.VIEWER)
def recording_matlab(run_id: str, reports: OfRuns) -> Response:
    """The recording of a run as a MATLAB file: a struct for each channel with values (SI), unit and label."""
    return CalculatedFile(PACKAGE, f"{run_id}.mat", MATLAB, _write_matlab, reports, run_id)


@router.post("/designsafe/check", response_model=Completeness, responses=told(503))
@allowed(Role.VIEWER)
def check(run_id: str, reports: OfRuns, given: Annotated[Metadata, Body()]) -> Response:
    """List every required entity and field that a data set for DesignSafe still needs, with how to mend it."""
    return Calculated(PACKAGE, _missing, reports, run_id, given)


@router.post("/designsafe.zip", response_class=FileResponse, responses=file(ZIP) | told(503))
@allowed(Role.VIEWER)
def designsafe(run_id: str, reports: OfRuns, given: Annotated[Metadata, Body()]) -> Response:
    """A data set for DesignSafe's Data Depot as a ZIP archive. It is refused while a required entity or field is missing."""
    return CalculatedFile(PACKAGE, f"{run_id}-designsafe.zip", ZIP, _write_designsafe, reports, run_id, given)


def _html(reports: RunReports, run_id: str, interactive: bool) -> Made:
    return as_html(reports.of(run_id).document, interactive)


def _pdf(reports: RunReports, run_id: str) -> Made:
    return as_pdf(reports.of(run_id).document, run_id)


def _write_matlab(path: Path, reports: RunReports, run_id: str) -> None:
    reports.of(run_id).write_matlab(path)


def _write_designsafe(path: Path, reports: RunReports, run_id: str, given: Metadata) -> None:
    reports.of(run_id).write_designsafe(path, given)


def _missing(reports: RunReports, run_id: str, given: Metadata) -> Completeness:
    issues = reports.of(run_id).missing(given)
    return Completeness(missing=[IssueOut.model_validate(one.as_dict()) for one in issues])
