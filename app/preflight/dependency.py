"""The preflight service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.dependencies import Library
from app.preflight.service import PreflightService


def preflight_service(request: Request, motions: Library) -> PreflightService:
    """The service of preflights."""
    return PreflightService(motions, request.app.state.dry_runs)


Preflights = Annotated[PreflightService, Depends(preflight_service)]
