"""REST endpoints of the reports of diagnoses, comparisons and sweeps."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import HTMLResponse, Response

from app.access import Role, allowed
from app.openapi import file, told
from app.publishing.answers import PDF, as_html, as_pdf
from app.publishing.dependency import OfComparisons, OfDiagnoses, OfSweeps

router = APIRouter(prefix="/api/v1", tags=["reports"])
Items = Annotated[
    list[str], Query(description="2 to 20 items, `run:ID` or `recording:ID`, with commas or repeated", max_length=100)
]
Reference = Annotated[str, Query(max_length=80)]
Station = Annotated[int, Query(ge=1, le=1000)]
Floor = Annotated[int, Query(ge=1, le=10_000)]
Result = Annotated[str, Query(description="key of the result that is shown in full", max_length=400)]


@router.get("/diagnoses/{diagnosis_id}/report.html", response_class=HTMLResponse, responses=told(409, 422))
@allowed(Role.VIEWER)
def diagnosis_html(diagnosis_id: str, reports: OfDiagnoses, interactive: bool = False) -> HTMLResponse:
    """The report of a diagnosis as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return as_html(reports.of(diagnosis_id), interactive)


@router.get("/diagnoses/{diagnosis_id}/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422))
@allowed(Role.VIEWER)
def diagnosis_pdf(diagnosis_id: str, reports: OfDiagnoses) -> Response:
    """The report of a diagnosis as PDF."""
    return as_pdf(reports.of(diagnosis_id), diagnosis_id)


@router.get("/compare/report.html", response_class=HTMLResponse, responses=told(404, 409))
@allowed(Role.VIEWER)
def comparison_html(
    items: Items, reports: OfComparisons, reference: Reference = "", station: Station = 1, floor: Floor = 1
) -> HTMLResponse:
    """The report of a comparison as one HTML file below 1 MB, with the signals of one station and one floor."""
    return as_html(reports.of(items, reference, station, floor), False)


@router.get("/compare/report.pdf", response_class=Response, responses=file(PDF) | told(404, 409))
@allowed(Role.VIEWER)
def comparison_pdf(
    items: Items, reports: OfComparisons, reference: Reference = "", station: Station = 1, floor: Floor = 1
) -> Response:
    """The report of a comparison as PDF, with the signals of one station and one floor."""
    return as_pdf(reports.of(items, reference, station, floor), "comparison")


@router.get("/sweeps/{sweep_id}/report.html", response_class=HTMLResponse)
@allowed(Role.VIEWER)
def sweep_html(sweep_id: str, reports: OfSweeps, measure: Result = "") -> HTMLResponse:
    """The report of a sweep as one HTML file below 1 MB: spread, best and worst points, and the influence of each input."""
    return as_html(reports.of(sweep_id, measure), False)


@router.get("/sweeps/{sweep_id}/report.pdf", response_class=Response, responses=file(PDF))
@allowed(Role.VIEWER)
def sweep_pdf(sweep_id: str, reports: OfSweeps, measure: Result = "") -> Response:
    """The report of a sweep as PDF: spread, best and worst points, and the influence of each input."""
    return as_pdf(reports.of(sweep_id, measure), sweep_id)
