"""The rig service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import OneSession
from app.rigs.service import RigService


def rig_service(session: OneSession) -> RigService:
    """The service of rigs in the session of the request."""
    return RigService(session)


Rigs = Annotated[RigService, Depends(rig_service)]
