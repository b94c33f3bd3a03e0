"""REST endpoints of drafts."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query
from fastapi import Path as InPath

from app.access import Role, allowed
from app.library.dependency import Drafts
from app.library.schemas import Closing, DraftDetail, DraftIn, DraftList, DraftOut

router = APIRouter(prefix="/api/v1/library/drafts", tags=["library of plans"])
DISCARDED = Closing()
DraftId = Annotated[str, InPath(max_length=36, pattern="^[A-Za-z0-9-]+$")]


@router.get("")
@allowed(Role.VIEWER)
def listed(
    drafts: Drafts,
    owner: Annotated[str | None, Query(max_length=80)] = None,
    closed: bool = False,
    origin: Annotated[str | None, Query(max_length=80)] = None,
) -> DraftList:
    """List the open drafts, last saved first. `owner` is a person's name, `origin` the id of the plan that drafts started from.

    With `closed`, the list has the drafts that were saved, queued or discarded.
    """
    return DraftList(drafts=drafts.listed(owner, closed, origin))


@router.get("/{draft_id}")
@allowed(Role.VIEWER)
def one(draft_id: str, drafts: Drafts) -> DraftDetail:
    """A draft with its plan as typed, and its problems in words."""
    return drafts.get(draft_id)


@router.put("/{draft_id}")
@allowed(Role.ENGINEER)
def save(draft_id: DraftId, asked: Annotated[DraftIn, Body()], drafts: Drafts) -> DraftOut:
    """Keep a plan as typed, valid or not. The status is 409 where another window has saved or closed the draft since.

    `revision` is the revision that the change starts from. With 0 and a new id, such as a UUID, a draft is made.
    A save is never in conflict with the last save of the same `writer`.
    """
    return drafts.save(draft_id, asked)


@router.post("/{draft_id}/close")
@allowed(Role.ENGINEER)
def close(draft_id: str, drafts: Drafts, asked: Annotated[Closing, Body()] = DISCARDED) -> DraftOut:
    """Take a draft off the list of open drafts. It stays stored and can be reopened."""
    return drafts.close(draft_id, asked.closed_as)


@router.post("/{draft_id}/reopen")
@allowed(Role.ENGINEER)
def reopen(draft_id: str, drafts: Drafts) -> DraftOut:
    """Bring a closed draft back to the list of open drafts."""
    return drafts.reopen(draft_id)
