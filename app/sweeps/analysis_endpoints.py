"""REST endpoints of what the results of a sweep say."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated
from app.openapi import told
from app.sweeps.analysis import SweepAnalysis
from app.sweeps.analysis_schemas import FragilityOut, SensitivityOut
from app.sweeps.dependency import Sweeps
from app.sweeps.preview import ANALYSIS

router = APIRouter(prefix="/api/v1/sweeps", tags=["sweeps"])
Key = Annotated[str, Query(max_length=400)]


@router.get("/{sweep_id}/fragility", response_model=FragilityOut, responses=told(503))
@allowed(Role.VIEWER)
def fragility(
    sweep_id: str,
    sweeps: Sweeps,
    measure: Key,
    level: Annotated[float, Query(allow_inf_nan=False)],
    intensity: Key,
    tripped: bool = True,
) -> Response:
    """The probability that the magnitude of a measure exceeds a level, against an intensity, over the points so far.

    `empirical` holds the shares of points, `median` and `dispersion` the lognormal curve of maximum likelihood. With `tripped`,
    a tripped point exceeds every level.
    """
    return Calculated(ANALYSIS, SweepAnalysis(sweeps).fragility, sweep_id, measure, level, intensity, tripped)


@router.get("/{sweep_id}/sensitivity", response_model=SensitivityOut, responses=told(503))
@allowed(Role.VIEWER)
def sensitivity(sweep_id: str, sweeps: Sweeps, measure: Key) -> Response:
    """How strongly a measure depends on each input over the completed points so far: the bars of a tornado diagram."""
    return Calculated(ANALYSIS, SweepAnalysis(sweeps).sensitivity, sweep_id, measure)
