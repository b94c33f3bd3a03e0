"""Examples in the OpenAPI description: requests that can be sent as they are, and answers made from their schemas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml

TEMPLATE = "linear-damper"
RUN = "6f1c2f0e-3d5b-4c7a-9a51-0c8f2f6f7d10"
RECORDING = "b2a4f4c8-5a0e-4a43-8d0c-51b7a0f4a9e3"
SHA256 = "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08"
WAITING = "1d4c7b52-8f0e-4a57-8d6b-2f3a9c5e7b64"
BY = {"by": "Ana Ruiz"}
RIG = {
    "name": "Shaker",
    "kind": "physical",
    "tests_at_a_time": 1,
    "actuators": [{"name": "North", "stroke": 0.25, "velocity": 0.5, "force": 1.0e6}],
    "retired": False,
}
MAPPING = {
    "schema": "rths-mapping/1",
    "test": "specimen",
    "channels": [
        {"column": "Time (s)", "role": "t", "unit": "s"},
        {"column": "Disp (mm)", "role": "x_meas", "number": 1, "unit": "mm"},
        {"column": "Force (kN)", "role": "f_meas", "number": 1, "unit": "kN"},
    ],
}
SWEEP = {
    "schema": "rths-sweep/1",
    "name": "Delay of the actuators against damping",
    "plan": TEMPLATE,
    "method": "grid",
    "fields": [
        {"path": "stations.*.actuator.alpha", "range": {"from": 10, "to": 40, "count": 4}},
        {"path": "structure.damping_ratio", "values": [1, 2, 5], "unit": "%"},
    ],
}
DESIGNSAFE = {
    "project": {"title": "Real-time hybrid simulation of a damped frame", "pi": "aruiz", "keywords": ["MR damper"]},
    "hybridSimulation": {
        "title": "Frame with MR dampers under the Northridge record",
        "authors": [{"fname": "Ana", "lname": "Ruiz", "inst": "Structures Laboratory"}],
        "keywords": ["real-time hybrid simulation"],
    },
    "license": "Open Data Commons Attribution",
}
ANNOTATION = {"from_s": 5.79, "station": 1, "text": "The command saturates for two cycles", "by": "Ana Ruiz"}
DRIVE = {"drive": {"amplitude": 0.02, "shape": {"kind": "sine", "frequency": 0.5}}, "controller_rate": 1024.0}


def plan() -> dict[str, Any]:
    """A plan as it is submitted."""
    return templates.template(TEMPLATE).as_dict()


DRAFT = {"name": "Brace B", "duration": "40 s", "stations": "not yet"}

PHRASE = "three bolts hold the brace"
LINK = "gO8Xy2rT0V5mXh3oJYk1c7uQfZ6sLw9bN4eR_aKpDtE"

# what a field of an answer shows; other fields are shown by the smallest value that their schema takes
FIELDS: dict[str, Any] = {
    "id": RUN,
    "number": 12,
    "name": "Linear damper",
    "test": "hybrid",
    "state": "queued",
    "digest": SHA256,
    "sha256": SHA256,
    "raw_sha256": SHA256,
    "code_version": "0.1.0",
    "template": TEMPLATE,
    "submitted_by": "Ana Ruiz",
    "imported_by": "Ana Ruiz",
    "open_ended": False,
    "duration_s": 40.0,
    "level": 0.01,
    "rig_id": "emulated",
    "rig_name": "Emulated laboratory",
    "kind": "emulated",
    "filename": "sine.csv",
    "mapping": MAPPING,
    "sweep": SWEEP,
}
REQUESTS: dict[str, Callable[[], Any]] = {
    "POST /api/v1/runs": lambda: {"plan": plan(), "submitted_by": "Ana Ruiz"},
    "POST /api/v1/runs/{run_id}/cancel": lambda: BY,
    "PATCH /api/v1/runs/{run_id}": lambda: {"name": "Brace, second calibration", "tags": ["calibration"], "notes": "New oil."},
    "POST /api/v1/runs/bulk": lambda: {"action": "tag", "runs": [RUN], "tags": ["calibration"]},
    "POST /api/v1/runs/views": lambda: {"name": "Calibrations", "query": "where=tag%3Dcalibration", "by": "Ana Ruiz"},
    "POST /api/v1/sign-in": lambda: {"name": "Ana Ruiz", "password": PHRASE},
    "POST /api/v1/sign-in/link": lambda: {"key": LINK, "password": PHRASE, "name": "Ana Ruiz"},
    "POST /api/v1/sign-in/link/read": lambda: {"key": LINK},
    "POST /api/v1/account/password": lambda: {"present": PHRASE, "password": "seven newtons on a spring"},
    "POST /api/v1/account/tokens": lambda: {"name": "nightly sweep", "scopes": ["read", "submit"], "days": 30},
    "POST /api/v1/accounts": lambda: {"name": "Ana Ruiz", "role": "engineer"},
    "PATCH /api/v1/accounts/{account_id}": lambda: {"role": "operator"},
    "POST /api/v1/abort": lambda: BY,
    "POST /api/v1/queue/hold": lambda: BY | {"reason": "oil leak"},
    "POST /api/v1/queue/release": lambda: BY,
    "POST /api/v1/queue/order": lambda: {"runs": [WAITING], "to": "top"},
    "POST /api/v1/queue/priority": lambda: {"runs": [WAITING], "priority": 1},
    "POST /api/v1/queue/cancel": lambda: BY | {"runs": [RUN]},
    "POST /api/v1/runs/{run_id}/undo-cancel": lambda: BY,
    "POST /api/v1/runs/{run_id}/retry": lambda: BY,
    "PUT /api/v1/rules": lambda: {"one_driver": False, "approvals": False, "approvers": []},
    "PUT /api/v1/retention": lambda: {
        "days": 365,
        "gigabytes": None,
        "states": ["cancelled", "failed"],
        "template": "",
        "tag": "",
    },
    "POST /api/v1/control/{rig_id}/take": lambda: BY,
    "POST /api/v1/control/{rig_id}/renew": lambda: BY,
    "POST /api/v1/control/{rig_id}/release": lambda: BY,
    "POST /api/v1/control/{rig_id}/request": lambda: BY,
    "POST /api/v1/control/{rig_id}/hand-over": lambda: BY | {"to": "Bea"},
    "POST /api/v1/control/{rig_id}/take-over": lambda: BY | {"reason": "the driver has left the laboratory"},
    "POST /api/v1/approvals/{about_id}/approve": lambda: BY | {"digest": "0" * 64},
    "POST /api/v1/approvals/{about_id}/reject": lambda: BY | {"reason": "the velocity is too high for this actuator"},
    "POST /api/v1/rigs": lambda: RIG,
    "POST /api/v1/webhooks": lambda: BY | {"url": "http://127.0.0.1:9/rths", "kinds": ["tripped", "failed"]},
    "PATCH /api/v1/webhooks/{webhook_id}": lambda: {"enabled": False},
    "PUT /api/v1/rigs/{rig_id}": lambda: RIG,
    "POST /api/v1/plans/check": plan,
    "POST /api/v1/plans/preflight": lambda: {
        "plan": plan(),
        "rig": "emulated",
    },
    "POST /api/v1/plans/identify": lambda: {"plan": plan(), "station": 1, "seconds": 5.0},
    "POST /api/v1/plans/drive": lambda: DRIVE,
    "POST /api/v1/plans/read": lambda: plan_to_yaml(templates.template(TEMPLATE)),
    "POST /api/v1/plans/write": plan,
    "POST /api/v1/library/plans": lambda: {"plan": plan(), "name": "Brace", "tags": ["braces"], "saved_by": "Ana Ruiz"},
    "POST /api/v1/library/import": lambda: plan_to_yaml(templates.template(TEMPLATE)),
    "PATCH /api/v1/library/plans/{plan_id}": lambda: {"name": "Brace, 100 kN", "tags": ["braces", "spring 2027"]},
    "POST /api/v1/library/plans/{plan_id}/versions": lambda: {"plan": plan(), "comment": "Higher limit"},
    "POST /api/v1/library/plans/{plan_id}/duplicate": lambda: {"name": "Brace without compensation", "saved_by": "Ana Ruiz"},
    "POST /api/v1/library/plans/{plan_id}/archive": lambda: BY,
    "PUT /api/v1/library/drafts/{draft_id}": lambda: {"plan": DRAFT, "revision": 0, "owner": "Ana Ruiz", "writer": "tab 1"},
    "POST /api/v1/library/drafts/{draft_id}/close": lambda: {"closed_as": "discarded"},
    "POST /api/v1/stability": plan,
    "POST /api/v1/sweeps": lambda: {"sweep": SWEEP, "submitted_by": "Ana Ruiz"},
    "POST /api/v1/sweeps/preview": lambda: SWEEP,
    "POST /api/v1/sweeps/fields": plan,
    "POST /api/v1/sweeps/{sweep_id}/cancel": lambda: BY,
    "POST /api/v1/sweeps/{sweep_id}/resume": lambda: BY,
    "POST /api/v1/sweeps/{sweep_id}/points/{point}/run": lambda: BY,
    "POST /api/v1/table4": lambda: BY,
    "POST /api/v1/recordings/preview": lambda: {"file": SHA256, "mapping": MAPPING},
    "POST /api/v1/mappings": lambda: {"file": SHA256, "mapping": MAPPING, "name": "Damper rig", "saved_by": "Ana Ruiz"},
    "PATCH /api/v1/mappings/{mapping_id}": lambda: {"name": "Damper rig, 100 kN"},
    "POST /api/v1/recordings": lambda: {"file": SHA256, "mapping": MAPPING, "name": "Sine test", "imported_by": "Ana Ruiz"},
    "POST /api/v1/runs/{run_id}/annotations": lambda: ANNOTATION,
    "PUT /api/v1/runs/{run_id}/annotations/{annotation_id}": lambda: ANNOTATION,
    "POST /api/v1/runs/{run_id}/designsafe/check": lambda: DESIGNSAFE,
    "POST /api/v1/runs/{run_id}/designsafe.zip": lambda: DESIGNSAFE,
    "PUT /api/v1/laboratory": lambda: {
        "name": "Structures Laboratory",
        "address": "12 Harbour Road, Wellington",
        "signatures": ["Test operator", "Approved by"],
    },
    "POST /api/v1/diagnoses": lambda: {"recording": {"run": RUN}, "level": 0.01, "submitted_by": "Ana Ruiz"},
    "POST /api/v1/diagnoses/{diagnosis_id}/cancel": lambda: BY,
    "POST /api/v1/diagnoses/{diagnosis_id}/simulations": lambda: BY,
}


def example(schema: dict[str, Any], schemas: dict[str, Any], name: str = "") -> Any:
    """A value that the schema takes; `schemas` holds what its references name, `name` is the field it is for."""
    if "$ref" in schema:
        key = schema["$ref"].rpartition("/")[2]
        return plan() if key == "Plan" else example(schemas[key], schemas, name)
    if name in FIELDS and _takes(schema, FIELDS[name], schemas):
        return FIELDS[name]
    choices = schema.get("anyOf") or schema.get("oneOf")
    if choices:
        nothing = any(one.get("type") == "null" for one in choices)
        return None if nothing else example(choices[0], schemas, name)
    if "const" in schema or "enum" in schema:
        return schema.get("const", schema.get("enum", [None])[0])
    if schema.get("type") == "object":
        return {key: example(inner, schemas, key) for key, inner in schema.get("properties", {}).items()}
    if schema.get("type") == "array":
        items = schema.get("prefixItems") or [schema.get("items", {})] * max(1, schema.get("minItems", 1))
        return [example(one, schemas) for one in items]
    return _plain(schema)


def _takes(schema: dict[str, Any], value: Any, schemas: dict[str, Any]) -> bool:
    """Whether the value is of one of the schema's types."""
    kinds = {"string": str, "number": float, "integer": int, "object": dict}
    found = [one for one in (schema, *schema.get("anyOf", ())) if isinstance(value, kinds.get(one.get("type", ""), ()))]
    return any(value in one.get("enum", [value]) for one in found)


def _plain(schema: dict[str, Any]) -> Any:
    if schema.get("format") == "date-time":
        return "2026-11-23T09:30:00Z"
    low = schema.get("minimum", schema.get("exclusiveMinimum", -1) + 1)
    return {"string": "text", "number": float(low), "integer": int(low), "boolean": False}.get(schema.get("type", ""))
