"""The run service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.calculations.answer import Calculating
from app.dependencies import Library, OneSession
from app.runs.service import RunService


def run_service(request: Request, session: OneSession, motions: Library, calculate: Calculating) -> RunService:
    """The service of runs in the session of the request."""
    return RunService(session, motions, request.app.state.queue, calculate)


Runs = Annotated[RunService, Depends(run_service)]
