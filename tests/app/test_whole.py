"""A request that replaces something gives all of it: what is left out is refused, and not reset."""

from __future__ import annotations

from fastapi.testclient import TestClient

from app.models import EMULATED

PARTS = {
    "/api/v1/library/drafts/{draft_id}",  # a plan as typed, and who types it where there are no accounts
    "/api/v1/runs/{run_id}/annotations/{annotation_id}",  # a time or a span, and who writes where there are no accounts
}


def test_every_put_needs_every_field(serving: TestClient) -> None:
    described = serving.get("/openapi.json").json()
    forms = described["components"]["schemas"]
    found = set()
    for path, operations in described["paths"].items():
        content = operations.get("put", {}).get("requestBody", {}).get("content", {})
        if "application/json" in content and path not in PARTS:
            form = forms[content["application/json"]["schema"]["$ref"].rpartition("/")[2]]
            assert form["properties"].keys() == set(form.get("required", ())), path
            found.add(path)
    assert len(found) >= 4 and described["paths"].keys() >= PARTS


def test_a_field_that_is_left_out_changes_nothing(serving: TestClient) -> None:
    for path in ("laboratory", "retention", "rules", f"rigs/{EMULATED}"):
        before = serving.get(f"/api/v1/{path}").json()
        refused = serving.put(f"/api/v1/{path}", json={})
        assert refused.status_code == 422 and len(refused.json()["errors"]) >= 3, path
        assert serving.get(f"/api/v1/{path}").json() == before
