"""What the OpenAPI document says is what the service answers: statuses, content types and bodies of every route."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from jsonschema import Draft202012Validator

from app.config import Settings
from app.main import create_app
from app.openapi_examples import RECORDING, REQUESTS, RUN, SHA256, WAITING
from tests.app.conftest import HERE, plan, unpack_earlier
from tests.engine import measurements

WITH_ROWS = {
    "run_id": "runs",
    "recording_id": "recordings",
    "diagnosis_id": "diagnoses",
    "sweep_id": "sweeps",
    "rig_id": "rigs",
    "webhook_id": "webhooks",
}
WRONG_BODIES: tuple[tuple[bytes, str], ...] = (
    (b"{", "application/json"),
    (b"\xff", "application/json"),
    (b"{}", "text/plain"),
    (b'{"colour": "red"}', "application/json"),
    (b"[1]", "application/json"),
    (b"null", "application/json"),
    (b'{"plan": 4, "mapping": 4, "by": 4, "recording": {"run": [1]}}', "application/json"),
    (b"x", "multipart/form-data; boundary=y"),
)


def application(client: TestClient) -> FastAPI:
    assert isinstance(client.app, FastAPI)
    return client.app


def document() -> Any:
    with TemporaryDirectory() as folder:
        return create_app(Settings(data=Path(folder), embedded_worker=False)).openapi()


def routes() -> list[str]:
    return [f"{method.upper()} {path}" for path, item in DOCUMENT["paths"].items() for method in item]


DOCUMENT = document()
ROUTES = routes()


def operation(route: str) -> dict[str, Any]:
    method, path = route.split(" ")
    found: dict[str, Any] = DOCUMENT["paths"][path][method.lower()]
    return found


def problems_of(value: Any, schema: dict[str, Any]) -> list[str]:
    whole = {**schema, "components": DOCUMENT["components"]}
    return [f"{error.json_path}: {error.message[:200]}" for error in Draft202012Validator(whole).iter_errors(value)]


def held(route: str, answer: Any) -> None:
    """The answer is one that its route says."""
    responses = operation(route)["responses"]
    told = f"{route} -> {answer.status_code} {answer.text[:300]}"
    assert str(answer.status_code) in responses, told
    content = responses[str(answer.status_code)].get("content", {})
    media = answer.headers.get("content-type", "").partition(";")[0]
    assert media in content or (not content and not answer.content), f"{told}: {media} is none of {list(content)}"
    if media.endswith("json"):
        assert problems_of(answer.json(), content[media].get("schema", {})) == [], told


def addresses(client: TestClient, route: str) -> Iterator[str]:
    """The route's address for every row, and for a row that is not there."""
    path = route.split(" ")[1]
    name = path.partition("{")[2].partition("}")[0]
    if not name:
        yield path
        return
    kind = WITH_ROWS.get(name)
    rows = client.get(f"/api/v1/{kind}").json()[kind] if kind else []
    known = {"sha256": [one["raw_sha256"] for one in client.get("/api/v1/recordings").json()["recordings"]]}
    known["name"] = ["two-storeys", "imperial-valley-1940-el-centro-ns"]
    for one in (*(row["id"] for row in rows), *known.get(name, ()), "nothing"):
        yield path.replace(f"{{{name}}}", one)


@pytest.mark.parametrize("route", ROUTES)
def test_the_summary_of_a_route_is_the_first_sentence_of_its_description(route: str) -> None:
    summary = operation(route)["summary"]
    assert operation(route)["description"].replace("\n", " ").startswith(summary) and " " in summary and len(summary) < 120


@pytest.mark.parametrize("route", [one for one in ROUTES if one.startswith("GET ")])
def test_every_get_answers_as_described(earlier: TestClient, route: str) -> None:
    for path in addresses(earlier, route):
        held(route, earlier.get(path))
    if operation(route).get("parameters"):
        held(route, earlier.get(next(addresses(earlier, route)), params={"limit": "x", "offset": "-1", "sort": "no"}))


@pytest.mark.parametrize("route", [one for one in ROUTES if "requestBody" in operation(one)])
def test_every_wrong_body_is_refused_as_described(earlier: TestClient, route: str) -> None:
    method, _ = route.split(" ")
    for path in addresses(earlier, route):
        for body, kind in WRONG_BODIES:
            held(route, earlier.request(method, path, content=body, headers={"content-type": kind}))
        large = {"content-length": str(10**9), "content-type": "application/json"}
        held(route, earlier.request(method, path, content=b"{}", headers=large))
        held(route, earlier.request(method, path, content=b"{}", headers={"origin": "http://elsewhere.example"}))


def test_the_examples_are_requests_that_are_taken(earlier: TestClient) -> None:
    """Those that name a row get one of this laboratory's."""
    run = next(one for one in earlier.get("/api/v1/runs").json()["runs"] if one["name"] == "Damper with play")
    recording = earlier.get("/api/v1/recordings").json()["recordings"][0]
    waiting = earlier.get("/api/v1/queue").json()["waiting"][0]["id"]
    real = {RUN: run["id"], WAITING: waiting, RECORDING: recording["id"], SHA256: recording["raw_sha256"]}
    for route in REQUESTS:
        method, path = route.split(" ")
        (content,) = operation(route)["requestBody"]["content"].items()
        media, given = content[0], content[1]["example"]
        if "{" in path or path.startswith(("/api/v1/sign-in", "/api/v1/account/")):  # needs an account: test_accounts.py
            assert problems_of(given, content[1]["schema"]) == []
            continue
        text = given if isinstance(given, str) else json.dumps(given)
        for shown, own in real.items():
            text = text.replace(shown, own)
        answer = earlier.request(method, path, content=text.encode(), headers={"content-type": media})
        assert answer.is_success, f"{route}: {answer.text[:500]}"
        held(route, answer)
    earlier.post("/api/v1/queue/release")


def test_every_json_body_and_every_answer_with_a_form_has_an_example_that_fits() -> None:
    for route in ROUTES:
        for media, content in operation(route).get("requestBody", {}).get("content", {}).items():
            assert "example" in content or media == "multipart/form-data", route
            if media == "application/json":
                assert problems_of(content["example"], content["schema"]) == [], route
        for status, response in operation(route)["responses"].items():
            content = response.get("content", {}).get("application/json", {})
            if status.startswith("2") and "$ref" in content.get("schema", {}):
                assert problems_of(content["example"], content["schema"]) == [], route


def test_what_changes_rows_answers_as_described(tmp_path_factory: pytest.TempPathFactory) -> None:
    settings = Settings(data=unpack_earlier(tmp_path_factory.mktemp("changed")), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), "http://127.0.0.1:8000", client=HERE) as client:
        raw = measurements.csv()
        held("POST /api/v1/recordings/files", client.post("/api/v1/recordings/files", files={"file": ("a.csv", raw)}))
        record = b"\n".join(b"%.2f %.4f" % (step / 100, step % 7 / 10) for step in range(200))
        for path in ("/api/v1/motions/preview", "/api/v1/motions"):
            form = {"unit": "m/s^2", "name": "mine"}
            held(f"POST {path}", client.post(path, files={"file": ("mine.txt", record)}, data=form))
        held("POST /api/v1/runs", client.post("/api/v1/runs", json={"plans": [plan(), plan()]}))
        for route in ROUTES:
            path = route.split(" ")[1]
            if path.endswith(("/cancel", "/simulations")):
                for address in addresses(client, route):
                    held(route, client.post(address))
                    held(route, client.post(address))
        for route in [one for one in ROUTES if one.startswith("DELETE ")]:
            for address in [*addresses(client, route), "/api/v1/motions/mine"]:
                if address.startswith(route.split(" ")[1].partition("{")[0]):
                    held(route, client.delete(address))


def test_a_plan_is_described_by_its_own_schema_wherever_it_is_given_or_answered() -> None:
    schemas = DOCUMENT["components"]["schemas"]
    reference = {"$ref": "#/components/schemas/Plan"}
    assert "motion" in schemas["Plan"]["properties"] and "Plan.RecordMotion" in schemas
    assert reference in schemas["Submission"]["properties"]["plan"]["anyOf"]
    for name in ("RunDetail", "DiagnosisDetail", "TemplateOut", "CheckOut"):
        assert schemas[name]["properties"]["plan"] == reference, name
    assert "HTTPValidationError" not in schemas and "ValidationError" not in schemas
    assert problems_of({"plan": plan()}, {"$ref": "#/components/schemas/Submission"}) == []
    Draft202012Validator.check_schema({"components": DOCUMENT["components"]})
