"""REST endpoints of the reports of diagnoses, comparisons and sweeps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Protocol

from fastapi import APIRouter, Query
from fastapi.responses import HTMLResponse, Response

from app.access import Role, allowed
from app.calculations.answer import Calculated, Made
from app.openapi import file, told
from app.publishing.answers import PDF, REPORT, as_html, as_pdf
from app.publishing.dependency import OfComparisons, OfDiagnoses, OfSweeps
from app.reports.document import Document

router = APIRouter(prefix="/api/v1", tags=["reports"])
Items = Annotated[
    list[str], Query(description="2 to 20 items, `run:ID` or `recording:ID`, with commas or repeated", max_length=100)
]
Reference = Annotated[str, Query(max_length=80)]
Station = Annotated[int, Query(ge=1, le=1000)]
Floor = Annotated[int, Query(ge=1, le=10_000)]
Result = Annotated[str, Query(description="key of the result that is shown in full", max_length=400)]


class Reports(Protocol):
    """Reports of one kind."""

    @property
    def of(self) -> Callable[..., Document]:
        """The report of what was asked for."""


@router.get("/diagnoses/{diagnosis_id}/report.html", response_class=HTMLResponse, responses=told(409, 422, 503))
@allowed(Role.VIEWER)
def diagnosis_html(diagnosis_id: str, reports: OfDiagnoses, interactive: bool = False) -> Response:
    """The report of a diagnosis as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return Calculated(REPORT, _html, reports, interactive, diagnosis_id)


@router.get("/diagnoses/{diagnosis_id}/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422, 503))
@allowed(Role.VIEWER)
def diagnosis_pdf(diagnosis_id: str, reports: OfDiagnoses) -> Response:
    """The report of a diagnosis as PDF."""
    return Calculated(REPORT, _pdf, reports, diagnosis_id, diagnosis_id)


@router.get("/compare/report.html", response_class=HTMLResponse, responses=told(404, 409, 503))
@allowed(Role.VIEWER)
def comparison_html(
    items: Items, reports: OfComparisons, reference: Reference = "", station: Station = 1, floor: Floor = 1
) -> Response:
    """The report of a comparison as one HTML file below 1 MB, with the signals of one station and one floor."""
    return Calculated(REPORT, _html, reports, False, items, reference, station, floor)


@router.get("/compare/report.pdf", response_class=Response, responses=file(PDF) | told(404, 409, 503))
@allowed(Role.VIEWER)
def comparison_pdf(
    items: Items, reports: OfComparisons, reference: Reference = "", station: Station = 1, floor: Floor = 1
) -> Response:
    """The report of a comparison as PDF, with the signals of one station and one floor."""
    return Calculated(REPORT, _pdf, reports, "comparison", items, reference, station, floor)


@router.get("/sweeps/{sweep_id}/report.html", response_class=HTMLResponse, responses=told(503))
@allowed(Role.VIEWER)
def sweep_html(sweep_id: str, reports: OfSweeps, measure: Result = "") -> Response:
    """The report of a sweep as one HTML file below 1 MB: spread, best and worst points, and the influence of each input."""
    return Calculated(REPORT, _html, reports, False, sweep_id, measure)


@router.get("/sweeps/{sweep_id}/report.pdf", response_class=Response, responses=file(PDF) | told(503))
@allowed(Role.VIEWER)
def sweep_pdf(sweep_id: str, reports: OfSweeps, measure: Result = "") -> Response:
    """The report of a sweep as PDF: spread, best and worst points, and the influence of each input."""
    return Calculated(REPORT, _pdf, reports, sweep_id, sweep_id, measure)


def _html(reports: Reports, interactive: bool, *asked: Any) -> Made:
    return as_html(reports.of(*asked), interactive)


def _pdf(reports: Reports, name: str, *asked: Any) -> Made:
    return as_pdf(reports.of(*asked), name)
