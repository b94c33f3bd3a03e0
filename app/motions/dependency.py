"""The service of ground motions of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import Library
from app.motions.service import MotionService


def motion_service(motions: Library) -> MotionService:
    """The service of ground motions."""
    return MotionService(motions)


Motions = Annotated[MotionService, Depends(motion_service)]
