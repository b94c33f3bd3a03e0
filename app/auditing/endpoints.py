"""REST endpoints of the audit log."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Query
from fastapi.responses import FileResponse, Response
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.access import Role, Scope, allowed
from app.auditing.repository import Wanted
from app.auditing.schemas import AuditList, ChainOut, HeadOut
from app.auditing.service import AuditService
from app.calculations.answer import Calculated, CalculatedFile
from app.calculations.bound import Bound
from app.dependencies import OneSession
from app.openapi import file, told
from app.text import Storable
from app.times import InUtc

router = APIRouter(prefix="/api/v1/audit", tags=["audit log"])
JSON_LINES = "application/jsonl"
CHAIN = Bound("reading of the whole log", seconds=600, megabytes=2000, mend="use `rths audit` on the server", long=True)


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


@router.get("/check", response_model=ChainOut, responses=told(503))
@allowed(Role.ENGINEER, Scope.READ)
def check(session: OneSession, head: Annotated[Storable, Query(max_length=90)] = "") -> Response:
    """Check the whole chain. `head` is NUMBER:HASH as noted earlier; the chain must still contain it."""
    return Calculated(CHAIN, AuditService(session).check, head)


@router.get("/export", response_class=FileResponse, responses=file(JSON_LINES) | told(422))
@allowed(Role.ENGINEER, Scope.READ)
def export(session: OneSession) -> Response:
    """Every entry as a line of JSON, the first one first. docs/audit.md has a script that checks the file."""
    return CalculatedFile(CHAIN, "audit.jsonl", JSON_LINES, _write, AuditService(session))


def _write(path: Path, audit: AuditService) -> None:
    with path.open("w", encoding="utf-8") as file:
        file.writelines(audit.lines())
