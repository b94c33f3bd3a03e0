"""HEAD answers as GET does, without the body and without making it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.responses import StreamingResponse
from fastapi.testclient import TestClient

from app.head import Head

PAGES = ("/", "/lab", "/new", "/runs", "/runs?sort=nonsense", "/recordings", "/diagnoses", "/table4", "/stability", "/nowhere")
OTHERS = ("/healthz", "/openapi.json", "/api/docs", "/api/v1/runs?limit=0", "/api/v1/nowhere", "/static/plotly.min.js")


def addresses(client: TestClient) -> Iterator[str]:
    """Every GET route of every row, and of a row that is not there."""
    ids: dict[str, list[str]] = {"name": ["two-storeys", "nothing"]}
    for kind, parameter in (("runs", "run_id"), ("recordings", "recording_id"), ("diagnoses", "diagnosis_id")):
        rows = client.get(f"/api/v1/{kind}").json()[kind]
        ids[parameter] = [*(row["id"] for row in rows), "nothing"]
        yield from (f"/{kind}/{one}" for one in ids[parameter])
    mappings, batches = client.get("/api/v1/mappings").json(), client.get("/api/v1/recordings/batches").json()
    ids["mapping_id"] = [*(row["id"] for row in mappings["mappings"]), "nothing"]
    ids["batch_id"] = [*(row["id"] for row in batches["batches"]), "nothing"]
    ids["sha256"] = [row["raw_sha256"] for row in client.get("/api/v1/recordings").json()["recordings"]]
    described: Any = client.app
    for path, item in described.openapi()["paths"].items():
        path = path.replace("{version}", "1").replace("{point}", "1")
        parameter = path.partition("{")[2].partition("}")[0]
        if "get" in item:
            values = ids.get(parameter, ["nothing"]) if parameter else [""]
            yield from (path.replace(f"{{{parameter}}}", value) for value in values)
    yield from (*PAGES, *OTHERS)


def test_every_address_answers_head_with_the_status_and_headers_of_get(earlier: TestClient) -> None:
    found = list(addresses(earlier))
    for path in found:
        get, head = (earlier.request(method, path, follow_redirects=False) for method in ("GET", "HEAD"))
        now = ("content-length",) if path in ("/metrics", "/readyz") else ()
        for moment in ("x-request-id", *now):
            get.headers.pop(moment, None), head.headers.pop(moment, None)
        assert (head.status_code, head.headers, head.content) == (get.status_code, get.headers, b""), path
    assert len(found) > 80


def test_the_body_is_not_made_for_head() -> None:
    app, made = FastAPI(), []

    def parts() -> Iterator[bytes]:
        made.append(1)
        yield b"x"

    @app.get("/file")
    def file() -> StreamingResponse:
        return StreamingResponse(parts())

    app.add_middleware(Head)
    client = TestClient(app)
    assert client.head("/file").status_code == 200 and made == []
    assert client.get("/file").content == b"x" and made == [1]


@pytest.mark.parametrize("path", ["/api/v1/plans/check", "/api/v1/runs/nothing/cancel"])
def test_head_is_not_possible_where_get_is_not(earlier: TestClient, path: str) -> None:
    answer = earlier.head(path)
    assert (answer.status_code, answer.headers["allow"]) == (405, "POST")
