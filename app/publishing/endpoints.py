"""REST endpoints of reports."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import HTMLResponse, Response

from app.openapi import file, told
from app.publishing.dependency import Reports
from app.reports import html
from app.reports.document import Document
from app.reports.pdf import pdf

router = APIRouter(prefix="/api/v1", tags=["reports"])
PDF = "application/pdf"


@router.get("/runs/{run_id}/report.html", response_class=HTMLResponse, responses=told(409, 422))
def run_html(run_id: str, reports: Reports, interactive: bool = False) -> HTMLResponse:
    """The report of a run as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return _html(reports.of_run(run_id), interactive)


@router.get("/runs/{run_id}/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422))
def run_pdf(run_id: str, reports: Reports) -> Response:
    """The report of a run as PDF."""
    return _pdf(reports.of_run(run_id), run_id)


@router.get("/diagnoses/{diagnosis_id}/report.html", response_class=HTMLResponse, responses=told(409, 422))
def diagnosis_html(diagnosis_id: str, reports: Reports, interactive: bool = False) -> HTMLResponse:
    """The report of a diagnosis as one HTML file below 1 MB; `interactive` gives plots that zoom, in about 5 MB."""
    return _html(reports.of_diagnosis(diagnosis_id), interactive)


@router.get("/diagnoses/{diagnosis_id}/report.pdf", response_class=Response, responses=file(PDF) | told(409, 422))
def diagnosis_pdf(diagnosis_id: str, reports: Reports) -> Response:
    """The report of a diagnosis as PDF."""
    return _pdf(reports.of_diagnosis(diagnosis_id), diagnosis_id)


def _html(document: Document, interactive: bool) -> HTMLResponse:
    return HTMLResponse(html.interactive(document) if interactive else html.light(document))


def _pdf(document: Document, name: str) -> Response:
    headers = {"Content-Disposition": f'inline; filename="{name}.pdf"'}
    return Response(pdf(document), media_type=PDF, headers=headers)
