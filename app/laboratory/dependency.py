"""The laboratory's identity of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import Configured
from app.laboratory.service import Laboratory


def laboratory(configured: Configured) -> Laboratory:
    """The identity of the laboratory."""
    return Laboratory(configured)


OneLaboratory = Annotated[Laboratory, Depends(laboratory)]
