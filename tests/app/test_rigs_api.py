"""Rigs by REST: their rules, and plans whose limits exceed a capacity."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from tests.app.conftest import plan

RIGS = "/api/v1/rigs"
NORTH = {"name": "North", "stroke": 0.15, "velocity": 0.5, "force": 5e5}

EVERY: dict[str, Any] = {"kind": "physical", "tests_at_a_time": None, "actuators": [], "retired": False}


def shaker(client: TestClient, **more: Any) -> Any:
    given = {"name": "Shaker", "kind": "physical", "actuators": [NORTH, {"stroke": 1.0}], **more}
    return client.post(RIGS, json=given).raise_for_status().json()


def test_the_emulated_laboratory_is_there_and_stays(client: TestClient) -> None:
    (first,) = client.get(RIGS).json()["rigs"]
    assert (first["id"], first["kind"], first["tests_at_a_time"]) == ("emulated", "emulated", None)
    assert client.delete(f"{RIGS}/emulated").status_code == 409
    changed = {**EVERY, "name": "Emulated laboratory", "kind": "emulated", "tests_at_a_time": 4}
    assert client.put(f"{RIGS}/emulated", json=changed).json()["tests_at_a_time"] == 4
    assert client.put(f"{RIGS}/emulated", json={**changed, "retired": True}).status_code == 409


def test_a_physical_rig_takes_one_test_and_a_name_is_taken_once(client: TestClient) -> None:
    rig = shaker(client)
    assert (rig["tests_at_a_time"], rig["running"], rig["queued"]) == (1, 0, 0)
    again = client.post(RIGS, json={"name": "shaker", "actuators": [NORTH]})
    assert (again.status_code, again.json()["detail"]) == (409, "There is already a rig with the name Shaker.")
    two = client.post(RIGS, json={"name": "Two", "actuators": [NORTH], "tests_at_a_time": 2})
    assert two.status_code == 422 and two.json()["errors"][0]["where"] == "tests_at_a_time"
    none = client.post(RIGS, json={"name": "None"})
    assert none.status_code == 422 and none.json()["errors"][0]["where"] == "actuators"


@pytest.mark.parametrize("actuator", [{"stroke": 0}, {"force": "strong"}, {"length": 1}])
def test_a_capacity_that_is_none_is_refused_with_its_field(serving: TestClient, actuator: dict[str, Any]) -> None:
    answer = serving.post(RIGS, json={"name": "Bad", "actuators": [actuator]})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["where"] == f"actuators.0.{next(iter(actuator))}"


def test_a_plan_beyond_a_capacity_is_refused_with_both_numbers(client: TestClient) -> None:
    rig = shaker(client)["id"]
    answer = client.post("/api/v1/runs", json={"plan": plan(), "rig": rig})
    assert answer.status_code == 422
    errors = {one["where"]: one for one in answer.json()["errors"]}
    stroke = errors["stations.0.limits.displacement"]
    assert stroke["value"] == "200 mm" and "stroke of 150 mm of actuator 1 (North) of rig Shaker" in stroke["problem"]
    assert stroke["fix"] == "lower the limit to 150 mm, or choose another rig"
    assert client.get("/api/v1/runs").json()["total"] == 0


def test_a_rig_needs_an_actuator_for_each_station_and_exists(client: TestClient) -> None:
    one = shaker(client, name="Small", actuators=[{"stroke": 5}])["id"]
    answer = client.post("/api/v1/runs", json={"plan": plan(), "rig": one})
    assert answer.json()["detail"] == (
        "stations: has 2 stations, but rig Small has 1 actuator (use fewer stations, or choose another rig)"
    )
    unknown = client.post("/api/v1/runs", json={"plan": plan(), "rig": "hall 3"})
    assert unknown.status_code == 422 and unknown.json()["errors"][0]["where"] == "rig"


def test_a_rig_in_use_is_retired_instead_of_deleted_and_keeps_its_promises(client: TestClient) -> None:
    given = {**EVERY, "name": "Shaker", "actuators": [{"stroke": 1.0}, {"stroke": 1.0}]}
    rig = client.post(RIGS, json=given).json()["id"]
    run = client.post("/api/v1/runs", json={"plan": plan(), "rig": rig}).json()["runs"][0]
    assert (run["rig_id"], run["rig_name"]) == (rig, "Shaker")
    smaller = client.put(f"{RIGS}/{rig}", json={**given, "actuators": [NORTH, NORTH]})
    assert smaller.status_code == 409 and "would not fit" in smaller.json()["detail"]
    assert client.get(f"{RIGS}/{rig}").json()["actuators"][0]["stroke"] == 1.0
    assert "1 run names Shaker" in client.delete(f"{RIGS}/{rig}").json()["detail"]
    assert client.put(f"{RIGS}/{rig}", json={**given, "retired": True}).json()["queued"] == 1
    late = client.post("/api/v1/runs", json={"plan": plan(), "rig": rig})
    assert late.status_code == 422 and "retired" in late.json()["detail"]
    unused = client.post(RIGS, json={**given, "name": "Unused"}).json()["id"]
    assert client.delete(f"{RIGS}/{unused}").status_code == 204 and client.get(f"{RIGS}/{unused}").status_code == 404


def test_undoing_a_cancel_asks_the_rig_again(client: TestClient) -> None:
    wide = {"stroke": 10.0, "velocity": 10.0, "force": 1e9}
    rig = client.post(RIGS, json={"name": "Wide", "kind": "physical", "actuators": [wide, wide]}).json()
    run = client.post("/api/v1/runs", json={"plan": plan(), "rig": rig["id"]}).json()["runs"][0]["id"]
    retired = {**EVERY, "name": "Wide", "actuators": [wide, wide], "retired": True}
    client.post(f"/api/v1/runs/{run}/cancel", json={})
    narrow = {**EVERY, "name": "Wide", "actuators": [{**wide, "stroke": 0.01}] * 2}
    assert client.put(f"{RIGS}/{rig['id']}", json=narrow).status_code == 200
    refused = client.post(f"/api/v1/runs/{run}/undo-cancel", json={})
    assert refused.status_code == 422 and "10 mm" in refused.json()["errors"][0]["problem"]
    assert client.put(f"{RIGS}/{rig['id']}", json=retired).status_code == 200
    assert "retired" in client.post(f"/api/v1/runs/{run}/undo-cancel", json={}).json()["errors"][0]["problem"]


def test_a_deleted_run_does_not_go_back_to_the_queue(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    client.post(f"/api/v1/runs/{run}/cancel", json={})
    assert client.delete(f"/api/v1/runs/{run}").status_code == 204
    answer = client.post(f"/api/v1/runs/{run}/undo-cancel", json={})
    assert answer.status_code == 409 and "is deleted" in answer.json()["detail"]


def test_a_rig_is_named_without_the_spaces_around_its_name(client: TestClient) -> None:
    given = {"kind": "emulated"}
    assert client.post(RIGS, json={"name": " Phys ", **given}).json()["name"] == "Phys"
    assert client.post(RIGS, json={"name": " phys ", **given}).status_code == 409
    blank = client.post(RIGS, json={"name": " ", **given})
    assert (blank.status_code, blank.json()["errors"][0]["problem"]) == (422, "is blank")
