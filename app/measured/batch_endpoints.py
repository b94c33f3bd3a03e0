"""REST endpoints of batches: many files of measurements imported by one mapping."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, File, Form, Query, UploadFile
from fastapi.responses import PlainTextResponse, Response

from app.access import Role, allowed
from app.measured.dependency import Batches
from app.measured.schemas import BatchList, BatchOut, BatchSummary
from app.openapi import file, told
from app.text import PersonName, Storable

router = APIRouter(prefix="/api/v1/recordings/batches", tags=["recordings"])


@router.post("", status_code=201, responses=told(503))
@allowed(Role.ENGINEER)
def add(
    batches: Batches,
    files: Annotated[list[UploadFile], File()],
    mapping: Annotated[Storable, Form(description="YAML or JSON")],
    imported_by: Annotated[PersonName, Form()] = "",
    trust_mapping: Annotated[bool, Form()] = False,
) -> BatchOut:
    """Import many files, or ZIP archives of files, by one mapping; the response is a table of what differs.

    Each file is imported or refused alone. A difference that would change the meaning of the numbers refuses its file: another
    unit, another order of columns that are mapped by number, another step where the mapping gives the step. A file that states
    another unit or step than the mapping is refused too, unless `trust_mapping` is true and most files state the same.
    """
    given = [(one.file, one.filename or "") for one in files]
    return batches.import_(given, mapping, imported_by, trust_mapping)


@router.get("")
@allowed(Role.VIEWER)
def listed(
    batches: Batches,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> BatchList:
    """List batches without their rows, newest first."""
    found, total = batches.listed(limit, offset)
    return BatchList(batches=[BatchSummary.model_validate(one) for one in found], total=total)


@router.get("/{batch_id}")
@allowed(Role.VIEWER)
def one(batch_id: str, batches: Batches) -> BatchOut:
    """A batch with a row for each file: its recording or the reasons against it, and what differs from the other files."""
    return batches.get(batch_id)


@router.get("/{batch_id}/table.csv", response_class=Response, responses=file("text/csv"))
@allowed(Role.VIEWER)
def table(batch_id: str, batches: Batches) -> PlainTextResponse:
    """The table of a batch as CSV."""
    headers = {"Content-Disposition": f'attachment; filename="{batch_id}.csv"'}
    return PlainTextResponse(batches.csv(batch_id), media_type="text/csv", headers=headers)
