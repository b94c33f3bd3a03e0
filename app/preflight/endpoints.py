"""REST endpoints of preflights and identifications."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated
from app.openapi import told
from app.preflight.calculation import DRY_RUN, IDENTIFICATION
from app.preflight.dependency import Preflights
from app.preflight.identified import IdentificationIn, IdentificationOut
from app.preflight.schemas import PreflightIn, PreflightOut
from app.preflight.service import identify as identification
from app.preflight.service import preflight as dry_run

router = APIRouter(prefix="/api/v1", tags=["plans"])


@router.post("/plans/preflight", response_model=PreflightOut, responses=told(503))
@allowed(Role.VIEWER)
def preflight(asked: PreflightIn, preflights: Preflights) -> Response:
    """Simulate a plan before it is queued. The response has the trip with its field, peaks against limits, and times.

    The dry run ignores the pace of the plan and stores nothing. Of a very long plan it covers the first part.
    """
    return Calculated(DRY_RUN, dry_run, asked, preflights.rig(asked), preflights.motions)


@router.post("/plans/identify", response_model=IdentificationOut, responses=told(503))
@allowed(Role.VIEWER)
def identify(asked: IdentificationIn, preflights: Preflights) -> Response:
    """Identify the delay of a station by a short random test of its emulated actuator and specimen.

    The response has three models with 95 % intervals, their residuals, and the fields of the compensator that follow. Nothing
    is stored, and the plan does not change.
    """
    return Calculated(IDENTIFICATION, identification, asked, preflights.motions)
