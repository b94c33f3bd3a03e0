"""Reports as bodies of responses, made in the process of a calculation."""

from __future__ import annotations

from app import headers
from app.calculations.answer import Made
from app.calculations.bound import Bound
from app.reports import html
from app.reports.document import Document
from app.reports.pdf import pdf

HTML, PDF = "text/html; charset=utf-8", "application/pdf"
REPORT = Bound("report", seconds=60, megabytes=3000, mend="compare fewer or shorter recordings", long=True)


def as_html(document: Document, interactive: bool) -> Made:
    """A report as HTML: light, or with plots that zoom."""
    made = html.interactive(document) if interactive else html.light(document)
    return Made(made.encode(), HTML, {headers.POLICY: headers.of_report(made)})


def as_pdf(document: Document, name: str) -> Made:
    """A report as PDF, which a browser shows."""
    shown = {"Content-Disposition": f'inline; filename="{name}.pdf"', headers.POLICY: headers.PDF}
    return Made(pdf(document), PDF, shown)
