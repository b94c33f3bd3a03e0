"""The preflight service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.db import unit_of_work
from app.dependencies import Library
from app.models import Rig
from app.preflight.service import PreflightService
from app.rigs.service import RigService


def preflight_service(request: Request, motions: Library) -> PreflightService:
    """The service of preflights."""

    def rig_of(rig_id: str) -> Rig:
        with unit_of_work(request.app.state.sessions) as session:
            rig = RigService(session).for_tests(rig_id)
            session.expunge(rig)
            return rig

    return PreflightService(motions, rig_of)


Preflights = Annotated[PreflightService, Depends(preflight_service)]
