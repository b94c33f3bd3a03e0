"""The page of a batch: many files imported by one mapping, and what differs between them."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.measured.dependency import Batches
from app.pages.errors import PageRoute
from app.pages.rendering import page
from rths_engine.recordings.batches.listing import sentence

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/recordings/batches/{batch_id}")
@allowed(Role.VIEWER)
def one(request: Request, batch_id: str, batches: Batches) -> HTMLResponse:
    """The page of a batch with a row for each file."""
    batch = batches.get(batch_id)
    reasons = [[sentence(one.model_dump()) for one in row.reasons] for row in batch.rows]
    return page(request, "batch.html", batch=batch, rows=list(zip(batch.rows, reasons, strict=True)))
