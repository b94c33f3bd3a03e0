"""REST endpoints of the reports of diagnoses."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import HTMLResponse, Response

from app.openapi import file, told
from app.publishing.answers import PDF, as_html, as_pdf
from app.publishing.dependency import OfDiagnoses

router = APIRouter(prefix="/api/v1", tags=["reports"])


@router.get("/diagnoses/{diagnosis_id}/report.html", response_class=HTMLResponse, responses=told(409, 422))
def diagnosis_html(diagnosis_id: str, reports: OfDiagnoses, interactive: bool = False) -> HTMLResponse:
    """The report of a diagnosis as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return as_html(reports.of(diagnosis_id), interactive)


@router.get("/diagnoses/{diagnosis_id}/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422))
def diagnosis_pdf(diagnosis_id: str, reports: OfDiagnoses) -> Response:
    """The report of a diagnosis as PDF."""
    return as_pdf(reports.of(diagnosis_id), diagnosis_id)
