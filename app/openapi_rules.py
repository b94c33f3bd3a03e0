"""Rules of requests that a JSON Schema cannot state, by route and field: `x-rules` of an operation.

A request that fits its schema can be refused with 422 for these fields only (`*`: any), and for fields that hold a plan, a
sweep, a mapping or a file, whose rules are checked by the engine.
"""

from __future__ import annotations

from typing import Any

ITEMS = {"items": "2 to 20 items of the form run:ID or recording:ID, each once", "reference": "one of the items"}
COLUMN = {"sort": "a column of the table", "columns": "columns of the table", "where": "an expression over columns"}
MEASURE = {"measure": "a column of numbers of the sweep", "intensity": "a column of numbers of the sweep"}
SPAN = {"to_s": "after from_s", "from_s": "within the run", "station": "a station of the run"}
PLACE = {"": "one of before, after and to", "runs": "tests that wait"}
RIG = {"actuators": "at least one for a physical rig"}
URL = {"url": "an address that begins with http:// or https://"}
WHOLE = {"*": "a plan, a sweep or a drive, checked by the engine"}

RULES: dict[str, dict[str, str]] = {
    "GET /api/v1/audit/check": {"head": "NUMBER:HASH"},
    "GET /api/v1/compare": ITEMS,
    "GET /api/v1/compare/signals": ITEMS,
    "GET /api/v1/compare/report.html": ITEMS,
    "GET /api/v1/compare/report.pdf": ITEMS,
    "GET /api/v1/library/differences": {
        "first": "version:ID:NUMBER, run:ID, draft:ID or template:NAME",
        "second": "the same",
    },
    "GET /api/v1/library/plans": {"sort": "name, changed_at, versions or saved_by"},
    "GET /api/v1/runs": COLUMN,
    "GET /api/v1/runs/table": COLUMN,
    "GET /api/v1/runs/table.csv": COLUMN,
    "GET /api/v1/sweeps/{sweep_id}/fragility": MEASURE,
    "GET /api/v1/sweeps/{sweep_id}/sensitivity": MEASURE,
    "GET /api/v1/sweeps/{sweep_id}/report.html": MEASURE,
    "GET /api/v1/sweeps/{sweep_id}/report.pdf": MEASURE,
    "GET /api/v1/sweeps/{sweep_id}/results": COLUMN,
    "PATCH /api/v1/webhooks/{webhook_id}": URL,
    "POST /api/v1/webhooks": URL,
    "POST /api/v1/accounts": {"name": "printable characters"},
    "POST /api/v1/plans/check": WHOLE,
    "POST /api/v1/plans/drive": WHOLE,
    "POST /api/v1/plans/write": WHOLE,
    "POST /api/v1/stability": WHOLE,
    "POST /api/v1/sweeps": WHOLE,
    "POST /api/v1/sweeps/fields": WHOLE,
    "POST /api/v1/sweeps/preview": WHOLE,
    "POST /api/v1/queue/order": PLACE,
    "POST /api/v1/runs": {"plan": "one of plan and plans", "rig": "a rig for the kind of test"},
    "POST /api/v1/rigs": RIG,
    "PUT /api/v1/rigs/{rig_id}": RIG,
    "POST /api/v1/runs/bulk": {"tags": "at least one tag for the action tag"},
    "POST /api/v1/runs/{run_id}/annotations": SPAN,
    "PUT /api/v1/runs/{run_id}/annotations/{annotation_id}": SPAN,
}


def add(route: str, operation: dict[str, Any]) -> None:
    """Add the rules of a route to its description."""
    if route in RULES:
        operation["x-rules"] = RULES[route]
