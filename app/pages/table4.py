"""The page of the comparison with Table IV."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse, Response

from app.access import Role, allowed
from app.pages.errors import PageRoute
from app.pages.parts import part
from app.pages.rendering import page
from app.pages.table4_chart import chart
from app.table4.dependency import Table4
from rths_engine import table4 as engine
from rths_engine.results.measures import measure
from rths_engine.table4.comparison import MEASURES as PUBLISHED

# measure -> heading, decimals as published
MEASURES = {key: (measure(key).heading, 1) for key in PUBLISHED}

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/table4")
@allowed(Role.VIEWER)
def whole(request: Request, table4: Table4) -> HTMLResponse:
    """The page of Table IV."""
    return page(request, "table4.html", record=engine.BUNDLED, **_now(table4))


@router.get("/table4/now")
@allowed(Role.VIEWER)
def now(request: Request, table4: Table4) -> Response:
    """The changing part of the page of Table IV."""
    return part(request, "table4_now.html", "/table4", lambda: _now(table4))


def _now(table4: Table4) -> dict[str, Any]:
    table = table4.table()
    return {"table": table, "measures": MEASURES, "chart": chart(table.simulations)}
