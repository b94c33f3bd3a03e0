"""The service of sweeps of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.dependencies import Configured, OneSession
from app.runs.dependency import Runs
from app.sweeps.service import SweepService


def sweep_service(request: Request, session: OneSession, runs: Runs, configured: Configured) -> SweepService:
    """The service of sweeps in the session of the request."""
    state = request.app.state
    return SweepService(session, runs, configured, state.dry_runs, state.queue)


Sweeps = Annotated[SweepService, Depends(sweep_service)]
