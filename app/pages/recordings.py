"""The pages of measured recordings: the list with the import, and one recording."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.config import MEGABYTE
from app.dependencies import Configured
from app.measured.dependency import Batches, Recordings
from app.pages.errors import PageRoute
from app.pages.rendering import page
from rths_engine.formats.registry import TITLES

LIMIT = 50
BATCHES = 5  # latest batches on the page

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/recordings")
@allowed(Role.VIEWER)
def listed(
    request: Request,
    configured: Configured,
    recordings: Recordings,
    batches: Batches,
    number: Annotated[int, Query(alias="page", ge=1, le=10**6)] = 1,
) -> HTMLResponse:
    """The page of all recordings with the import of files."""
    found, total = recordings.listed(LIMIT, LIMIT * (number - 1))
    part: dict[str, Any] = {"recordings": found, "total": total, "number": number, "first": LIMIT * (number - 1) + 1}
    offered: dict[str, Any] = {"formats": TITLES, "limit_mb": configured.measurements_limit // MEGABYTE}
    latest, _ = batches.listed(BATCHES, 0)
    many: dict[str, Any] = {"batches": latest, "most_files": batches.limits.files, "earlier": recordings.mappings()}
    return page(request, "recordings.html", **part, **offered, **many)


@router.get("/recordings/{recording_id}")
@allowed(Role.VIEWER)
def one(request: Request, recording_id: str, recordings: Recordings) -> HTMLResponse:
    """The page of a recording."""
    return page(request, "recording.html", recording=recordings.get(recording_id))
