"""Write a report in the form that the ending of its file names."""

from __future__ import annotations

from pathlib import Path

from app.reports import html
from app.reports.document import Document
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

HTML, PDF = (".html", ".htm"), ".pdf"


def check(path: Path | None) -> None:
    """Raise RthsError where the ending of a report's file is neither that of HTML nor that of PDF."""
    if path and path.suffix.lower() not in (*HTML, PDF):
        raise RthsError(Issue(str(path), "needs the ending .html or .pdf", fix="choose another name for the report"))


def write(document: Document, path: Path) -> None:
    """Write a report as HTML or PDF, completely or not at all."""
    if path.suffix.lower() != PDF:
        files.write(path, html.light(document))
        return
    from app.reports.pdf import pdf

    with files.temporary(path) as written:
        written.write_bytes(pdf(document))
        written.replace(path)
