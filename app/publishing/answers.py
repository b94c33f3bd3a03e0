"""Reports and files as responses."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from fastapi.responses import FileResponse, HTMLResponse, Response
from starlette.background import BackgroundTask

from app import headers
from app.reports import html
from app.reports.document import Document
from app.reports.pdf import pdf

PDF = "application/pdf"


def as_html(document: Document, interactive: bool) -> HTMLResponse:
    """A report as HTML: light, or with plots that zoom."""
    made = html.interactive(document) if interactive else html.light(document)
    return HTMLResponse(made, headers={headers.POLICY: headers.of_report(made)})


def as_pdf(document: Document, name: str) -> Response:
    """A report as PDF, which a browser shows."""
    shown = {"Content-Disposition": f'inline; filename="{name}.pdf"', headers.POLICY: headers.PDF}
    return Response(pdf(document), media_type=PDF, headers=shown)


def as_file(write: Callable[[Path], None], name: str, media_type: str) -> FileResponse:
    """A file that `write` makes at a temporary path, which is removed after it was sent. What `write` raises passes on."""
    with tempfile.NamedTemporaryFile(suffix=f"-{name}", delete=False) as made:
        path = Path(made.name)
    try:
        write(path)
    except BaseException:
        path.unlink(missing_ok=True)
        raise
    return FileResponse(path, media_type=media_type, filename=name, background=BackgroundTask(path.unlink, missing_ok=True))
