"""REST endpoints of preflights and identifications."""

from __future__ import annotations

from fastapi import APIRouter

from app.openapi import told
from app.preflight.dependency import Preflights
from app.preflight.identified import IdentificationIn, IdentificationOut
from app.preflight.schemas import PreflightIn, PreflightOut

router = APIRouter(prefix="/api/v1", tags=["plans"])


@router.post("/plans/preflight", responses=told(503))
def preflight(asked: PreflightIn, preflights: Preflights) -> PreflightOut:
    """Simulate a plan before it is queued. The response has the trip with its field, peaks against limits, and times.

    The dry run ignores the pace of the plan and stores nothing. Of a very long plan it covers the first part.
    """
    return PreflightOut(**preflights.preflight(asked))


@router.post("/plans/identify", responses=told(503))
def identify(asked: IdentificationIn, preflights: Preflights) -> IdentificationOut:
    """Identify the delay of a station by a short random test of its emulated actuator and specimen.

    The response has three models with 95 % intervals, their residuals, and the fields of the compensator that follow. Nothing
    is stored, and the plan does not change.
    """
    return IdentificationOut(**preflights.identify(asked))
