"""One person drives a rig: who may start, hold and stop its tests once the laboratory has this rule."""

from __future__ import annotations

from datetime import timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.models import EMULATED, RigControl
from tests.app.conftest import app_of, plan

CONTROL = f"/api/v1/control/{EMULATED}"
RULES = {"one_driver": False, "approvals": False, "approvers": []}


@pytest.fixture
def driven(client: TestClient) -> TestClient:
    """The service of a laboratory with the rule, whose emulated laboratory Ana drives."""
    assert client.put("/api/v1/rules", json=RULES | {"one_driver": True}).status_code == 200
    assert act(client, "take", "Ana").json()["sentence"] == "Ana drives Emulated laboratory."
    return client


def act(client: TestClient, what: str, by: str, **more: Any) -> Any:
    return client.post(f"{CONTROL}/{what}", json={"by": by, **more})


def submit(client: TestClient, by: str) -> Any:
    return client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": by})


def driver(client: TestClient) -> str | None:
    found: str | None = client.get("/api/v1/control").json()["rigs"][0]["driver"]
    return found


def test_without_the_rule_nothing_changes(client: TestClient) -> None:
    assert client.get("/api/v1/rules").json()["one_driver"] is False
    assert act(client, "take", "Ana").status_code == 200
    run = submit(client, "Bea").json()["runs"][0]["id"]
    assert client.post(f"/api/v1/runs/{run}/cancel", json={"by": "Cem"}).status_code == 200
    assert client.post("/api/v1/queue/hold", json={"by": "Cem"}).status_code == 200


def test_only_the_driver_submits_cancels_retries_and_releases(driven: TestClient) -> None:
    refused = submit(driven, "Bea")
    assert refused.status_code == 409
    assert "Ana drives Emulated laboratory until" in refused.json()["detail"]
    assert f"Ask Ana for the control on the page Queue, or by POST {CONTROL}/request" in refused.json()["detail"]
    run = submit(driven, "Ana").json()["runs"][0]["id"]
    changes: list[tuple[str, dict[str, Any]]] = [
        (f"runs/{run}/cancel", {}),
        ("queue/hold", {"reason": "oil"}),
        ("queue/release", {}),
    ]
    for path, body in changes:
        assert driven.post(f"/api/v1/{path}", json={**body, "by": "Bea"}).status_code == 409, path
    left = driven.post("/api/v1/queue/cancel", json={"runs": [run], "by": "Bea"}).json()
    assert not left["cancelled"] and "Run 1: Ana drives" in left["refused"][0]["reason"]
    for path, body in [*changes[1:], changes[0]]:
        assert driven.post(f"/api/v1/{path}", json={**body, "by": "Ana"}).status_code == 200, path
    for what in ("undo-cancel", "retry"):
        assert driven.post(f"/api/v1/runs/{run}/{what}", json={"by": "Bea"}).status_code == 409
    assert driven.post(f"/api/v1/runs/{run}/retry", json={"by": "Ana"}).status_code == 201


def test_people_who_do_not_drive_read_why_before_they_try(driven: TestClient) -> None:
    def told(by: str) -> Any:
        return driven.get("/api/v1/control", params={"by": by}).json()

    submit(driven, "Ana")
    for path, refusal in [("queue/hold", "hold_refusal"), ("queue/release", "release_refusal")]:
        assert told("Ana")[refusal] is None
        assert driven.post(f"/api/v1/{path}", json={"by": "Bea"}).json()["detail"] == told("Bea")[refusal], path
    assert told("Ana")["refusals"] == {} and told("Bea")["refusals"] == {EMULATED: told("Bea")["hold_refusal"]}
    assert driven.put("/api/v1/rules", json=RULES).status_code == 200
    bea = told("Bea")
    assert (bea["refusals"], bea["hold_refusal"], bea["release_refusal"]) == ({}, None, None)


def test_a_rig_that_nobody_drives_takes_no_test_and_the_refusal_says_how_to_take_it(driven: TestClient) -> None:
    assert act(driven, "release", "Ana").status_code == 200
    refused = submit(driven, "Ana").json()["detail"]
    assert refused.startswith("Nobody drives Emulated laboratory") and f"POST {CONTROL}/take" in refused


def test_abort_needs_no_control(driven: TestClient) -> None:
    assert driven.post("/api/v1/abort", json={"by": "Bea"}).status_code == 200
    assert driven.get("/api/v1/queue").json()["held"]


def test_the_queue_is_held_by_a_driver_of_one_rig_and_released_by_the_drivers_of_all(driven: TestClient) -> None:
    rig = {"name": "Frame", "actuators": [{"stroke": 0.5, "velocity": None, "force": None}]}
    frame = driven.post("/api/v1/rigs", json=rig).json()["id"]
    assert driven.post(f"/api/v1/control/{frame}/take", json={"by": "Bea"}).status_code == 200
    assert submit(driven, "Ana").status_code == 201
    assert driven.post("/api/v1/queue/hold", json={"by": "Bea"}).status_code == 200
    assert driven.post("/api/v1/queue/release", json={"by": "Bea"}).status_code == 409
    assert driven.post("/api/v1/queue/release", json={"by": "Ana"}).status_code == 200


def test_the_control_is_asked_for_handed_over_and_taken_over(driven: TestClient) -> None:
    assert act(driven, "take", "Bea").status_code == 409
    assert act(driven, "request", "Bea").json()["asked_by"] == "Bea"
    assert act(driven, "hand-over", "Bea", to="Bea").status_code == 409
    assert act(driven, "hand-over", "Ana", to="Bea").json()["driver"] == "Bea"
    assert driven.get("/api/v1/control", params={"by": "Bea"}).json()["rigs"][0]["yours"]
    assert act(driven, "take-over", "Cem").status_code == 422
    assert act(driven, "take-over", "Cem", reason="Bea is ill").json()["driver"] == "Cem"
    assert submit(driven, "Bea").status_code == 409 and submit(driven, "Cem").status_code == 201
    entry = driven.get("/api/v1/audit", params={"action": "control.take_over"}).json()["entries"][0]
    assert entry["who"] == "Cem" and entry["details"]["given"]["reason"] == "Bea is ill"


def test_the_control_ends_without_renewal(driven: TestClient) -> None:
    assert act(driven, "renew", "Ana").status_code == 200 and act(driven, "renew", "Bea").status_code == 409
    with app_of(driven).state.sessions.begin() as session:
        held = session.get_one(RigControl, EMULATED)
        held.until -= timedelta(minutes=11)
    assert driver(driven) is None and act(driven, "renew", "Ana").status_code == 409
    assert act(driven, "take", "Bea").status_code == 200 and driver(driven) == "Bea"


@pytest.mark.parametrize("left_out", [*RULES])
def test_a_rule_that_is_left_out_is_refused_and_switches_nothing_off(driven: TestClient, left_out: str) -> None:
    given = {name: value for name, value in RULES.items() if name != left_out}
    refused = driven.put("/api/v1/rules", json=given)
    assert refused.status_code == 422 and [one["where"] for one in refused.json()["errors"]] == [left_out]
    assert driven.get("/api/v1/rules").json()["one_driver"]


def test_without_accounts_names_are_free(driven: TestClient) -> None:
    assert act(driven, "hand-over", "Ana", to="Somebody Else").json()["driver"] == "Somebody Else"
    assert driven.put("/api/v1/rules", json=RULES | {"approvers": ["Bea", "Bea"]}).json()["approvers"] == ["Bea"]


def test_bad_requests_say_what_is_wrong(client: TestClient) -> None:
    assert client.post("/api/v1/control/nowhere/take", json={"by": "Ana"}).status_code == 404
    assert act(client, "take", " ").json()["errors"][0]["where"] == "by"
    assert act(client, "request", "Ana").status_code == 409  # nobody drives it
    with app_of(client).state.sessions() as session:
        assert session.scalar(sa.select(sa.func.count()).select_from(RigControl)) == 0
