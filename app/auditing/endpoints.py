"""REST endpoints of the audit log."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import StreamingResponse
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.access import Role, Scope, allowed
from app.auditing.repository import Wanted
from app.auditing.schemas import AuditList, ChainOut, HeadOut
from app.auditing.service import AuditService
from app.db import unit_of_work
from app.dependencies import OneSession
from app.openapi import file, told
from app.text import Storable
from app.times import InUtc

router = APIRouter(prefix="/api/v1/audit", tags=["audit log"])
JSON_LINES = "application/jsonl"


class Asked(BaseModel):
    """Filter and page of the log. An empty parameter is ignored; a time without a time zone is UTC."""

    model_config = ConfigDict(extra="forbid")

    who: Storable = Field("", max_length=80, description="part of the name of the person or worker")
    action: Storable = Field("", max_length=80, description="part of the action, such as `runs.` or `refused`")
    since: InUtc | None = None
    until: InUtc | None = None
    run: Storable = Field("", max_length=36, description="number or id of a run")
    limit: int = Field(50, ge=1, le=500)
    offset: int = Field(0, ge=0, le=10**9)

    @model_validator(mode="before")
    @classmethod
    def _given(cls, query: dict[str, Any]) -> dict[str, Any]:
        return {name: value for name, value in query.items() if value not in ("", [""])}


@router.get("")
@allowed(Role.ENGINEER, Scope.READ)
def listed(asked: Annotated[Asked, Query()], session: OneSession) -> AuditList:
    """List the entries of the audit log, newest first: who did what, to what, and when."""
    return AuditService(session).listed(Wanted(**asked.model_dump()))


@router.get("/head")
@allowed(Role.ENGINEER, Scope.READ)
def head(session: OneSession) -> HeadOut:
    """The last entry of the log: note it elsewhere, and check the log against it later."""
    return AuditService(session).head()


@router.get("/check", responses=told(503))
@allowed(Role.ENGINEER, Scope.READ)
def check(session: OneSession, head: Annotated[Storable, Query(max_length=90)] = "") -> ChainOut:
    """Check the whole chain. `head` is NUMBER:HASH as noted earlier; the chain must still contain it."""
    return AuditService(session).check(head)


@router.get("/export", response_class=StreamingResponse, responses=file(JSON_LINES))
@allowed(Role.ENGINEER, Scope.READ)
def export(request: Request) -> StreamingResponse:
    """Every entry as a line of JSON, the first one first. docs/audit.md has a script that checks the file."""

    def lines() -> Iterator[str]:
        with unit_of_work(request.app.state.sessions) as session:
            yield from AuditService(session).lines()

    headers = {"Content-Disposition": 'attachment; filename="audit.jsonl"'}
    return StreamingResponse(lines(), media_type=JSON_LINES, headers=headers)
