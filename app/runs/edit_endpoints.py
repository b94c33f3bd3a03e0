"""REST endpoints of what people say about runs."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Depends
from fastapi.responses import Response

from app.access import Role, allowed
from app.dependencies import OneSession, OneStore
from app.runs.editing import RunEditing
from app.runs.schemas import RunOut
from app.runs.table_schemas import BulkChange, BulkResult, RunChange, TagList

router = APIRouter(prefix="/api/v1", tags=["runs"])


def editing(session: OneSession) -> RunEditing:
    """The changes of runs in the session of the request."""
    return RunEditing(session)


Editing = Annotated[RunEditing, Depends(editing)]


@router.get("/runs/tags")
@allowed(Role.VIEWER)
def tags(runs: Editing) -> TagList:
    """Every tag that a run has."""
    return TagList(tags=runs.tags())


@router.post("/runs/bulk")
@allowed(Role.ENGINEER)
def bulk(body: Annotated[BulkChange, Body()], runs: Editing) -> BulkResult:
    """Tag, archive, delete or restore several runs. Runs for which this is not allowed stay as they are and are listed."""
    return runs.bulk(body.action, body.runs, body.tags)


@router.patch("/runs/{run_id}")
@allowed(Role.ENGINEER)
def change(run_id: str, body: Annotated[RunChange, Body()], runs: Editing) -> RunOut:
    """Change name, tags, notes or shelf of a run. The plan and its digest stay as they are."""
    return RunOut.of(runs.change(run_id, body))


@router.delete("/runs/{run_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def delete(run_id: str, runs: Editing, store: OneStore) -> None:
    """Delete a run. For 7 days it can be restored; after that its row and its recording are removed."""
    runs.delete(run_id)
    runs.purge(store)


@router.post("/runs/{run_id}/restore")
@allowed(Role.ENGINEER)
def restore(run_id: str, runs: Editing) -> RunOut:
    """Restore a deleted run."""
    return RunOut.of(runs.restore(run_id))
