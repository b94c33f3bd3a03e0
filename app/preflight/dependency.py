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
    """The service of preflights. Its session ends before the dry run begins."""

    def rig_of(rig_id: str) -> Rig:
        with unit_of_work(request.app.state.sessions) as session:
            rig = RigService(session).for_tests(rig_id)
            session.expunge(rig)
            return rig

    state = request.app.state
    return PreflightService(motions, state.dry_runs, state.identifications, rig_of)


Preflights = Annotated[PreflightService, Depends(preflight_service)]
