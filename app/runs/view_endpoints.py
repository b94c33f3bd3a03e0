"""REST endpoints of saved views of the run table."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Depends
from fastapi.responses import Response

from app.access import Role, allowed
from app.dependencies import OneSession
from app.runs.table_schemas import ViewIn, ViewList, ViewOut
from app.runs.views import ViewService

router = APIRouter(prefix="/api/v1", tags=["runs"])


def view_service(session: OneSession) -> ViewService:
    """The saved views in the session of the request."""
    return ViewService(session)


Views = Annotated[ViewService, Depends(view_service)]


@router.get("/runs/views")
@allowed(Role.VIEWER)
def listed(views: Views) -> ViewList:
    """The saved views of the run table."""
    return ViewList(views=[ViewOut.model_validate(one) for one in views.listed()])


@router.post("/runs/views", status_code=201)
@allowed(Role.ENGINEER)
def save(body: Annotated[ViewIn, Body()], views: Views) -> ViewOut:
    """Save a view of the run table under a name; a view with this name is replaced."""
    return ViewOut.model_validate(views.save(body.name, body.query, body.by))


@router.delete("/runs/views/{view_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(view_id: str, views: Views) -> None:
    """Delete a saved view. Runs stay as they are."""
    views.remove(view_id)
