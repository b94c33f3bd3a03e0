"""The table of REST routes, from the OpenAPI document."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from app.config import PROBES, Settings
from app.documents.markdown import code, table
from app.main import create_app

JSON = "application/json"
EVERY = {"default", "401", "403", "421", "503"}  # answers of every route, said above the table


def routes() -> str:
    """Every route: what it does, the fields of its query and of its body, and the statuses of its answers."""
    with tempfile.TemporaryDirectory() as data:
        api = create_app(Settings(data=Path(data), embedded_worker=False)).openapi()
    return table(["route", "does", "query", "body", "statuses"], _rows(api))


def _rows(api: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    for path, methods in api["paths"].items():
        for method, route in methods.items():
            query = [code(one["name"]) for one in route.get("parameters", []) if one["in"] == "query"]
            does = str(route["description"]).partition("\n\n")[0]
            yield (
                code(f"{method.upper()} {path}"),
                does,
                ", ".join(query),
                _body(route.get("requestBody", {}), api),
                ", ".join(sorted(one for one in route["responses"] if one not in EVERY or (path in PROBES and one == "503"))),
            )


def _body(body: Mapping[str, Any], api: Mapping[str, Any]) -> str:
    """The fields of a body and what it is sent as, where not as JSON."""
    for kind, content in body.get("content", {}).items():
        fields = _fields(content.get("schema", {}), api)
        names = "a plan" if fields[:1] == ["schema"] else ", ".join(code(one) for one in fields)
        return names if kind == JSON else f"{names} ({code(kind)})".strip()
    return ""


def _fields(schema: Mapping[str, Any], api: Mapping[str, Any]) -> list[str]:
    if "$ref" in schema:
        return _fields(api["components"]["schemas"][schema["$ref"].rsplit("/", 1)[1]], api)
    return [*schema.get("properties", {})] or [name for one in schema.get("anyOf", []) for name in _fields(one, api)]
