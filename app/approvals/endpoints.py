"""REST endpoints of approvals."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, HTTPException, Query

from app.access import Role, Who, allowed
from app.approvals.dependency import Approvals
from app.approvals.schemas import ApprovalList, Approve, Decided, Reject
from app.approvals.service import NoRight
from app.openapi import told
from app.text import Storable

router = APIRouter(prefix="/api/v1/approvals", tags=["control"])


@router.get("")
@allowed(Role.VIEWER)
def listed(approvals: Approvals, who: Who, by: Annotated[Storable, Query(max_length=80)] = "") -> ApprovalList:
    """List what waits for approval, oldest first. `by` is the name of the reader where there are no accounts."""
    return approvals.listed(who, who.named(by))


@router.post("/{about_id}/approve", responses=told(403))
@allowed(Role.OPERATOR)
def approve(about_id: str, approvals: Approvals, who: Who, given: Annotated[Approve, Body()]) -> Decided:
    """Queue a run or a sweep that another person submitted. Exactly what has this digest runs."""
    try:
        return approvals.approve(about_id, who, who.named(given.by), given.digest)
    except NoRight as error:
        raise HTTPException(403, str(error)) from None


@router.post("/{about_id}/reject", responses=told(403))
@allowed(Role.OPERATOR)
def reject(about_id: str, approvals: Approvals, who: Who, given: Annotated[Reject, Body()]) -> Decided:
    """Reject a run or a sweep that another person submitted, with a reason. It ends as cancelled."""
    try:
        return approvals.reject(about_id, who, who.named(given.by), given.reason)
    except NoRight as error:
        raise HTTPException(403, str(error)) from None
