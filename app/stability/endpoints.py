"""REST endpoint of stability, and plotly.js for its page."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Annotated, Any

from fastapi import APIRouter, Body
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated
from app.openapi import PLAN, told
from app.stability.service import STABILITY, predicted

router = APIRouter(tags=["plans"])


@router.post("/api/v1/stability", response_model=dict[str, Any], responses=told(503))
@allowed(Role.VIEWER)
async def predict(plan: Annotated[Any, PLAN, Body()]) -> Response:
    """Predict the stability of a plan about rest: spectral radius, modes, delay margins, and a map over two delays."""
    return Calculated(STABILITY, predicted, plan)


@router.get("/static/plotly.min.js", include_in_schema=False)
@allowed(Role.VIEWER)
def plotly() -> Response:
    """plotly.js from the installed package plotly."""
    headers = {"Cache-Control": "public, max-age=86400"}
    return Response(_plotly(), media_type="text/javascript", headers=headers)


@cache
def _plotly() -> bytes:
    return (files("plotly") / "package_data" / "plotly.min.js").read_bytes()
