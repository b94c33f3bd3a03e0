"""The service of approvals of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.approvals.service import ApprovalService
from app.dependencies import OneSession
from app.runs.dependency import Runs
from app.sweeps.dependency import Sweeps


def approval_service(session: OneSession, runs: Runs, sweeps: Sweeps) -> ApprovalService:
    """The service of approvals in the session of the request."""
    return ApprovalService(session, runs, sweeps)


Approvals = Annotated[ApprovalService, Depends(approval_service)]
