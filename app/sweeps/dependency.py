"""The service of sweeps of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.calculations.answer import Calculating
from app.dependencies import Configured, OneSession
from app.runs.dependency import Runs
from app.sweeps.service import SweepService


def sweep_service(
    request: Request, session: OneSession, runs: Runs, configured: Configured, calculate: Calculating
) -> SweepService:
    """The service of sweeps in the session of the request."""
    return SweepService(session, runs, configured, calculate, request.app.state.queue)


Sweeps = Annotated[SweepService, Depends(sweep_service)]
