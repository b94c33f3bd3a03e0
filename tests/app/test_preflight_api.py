"""Preflight by REST and on the command line; the service answers other requests meanwhile."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.cli.main import main
from app.config import Settings
from app.main import create_app
from app.preflight import endpoints
from app.preflight.calculation import DRY_RUN, IDENTIFICATION
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml
from tests.app.conftest import ADDRESS, HERE, plan

PATH = "/api/v1/plans/preflight"


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """One service for the tests of this file."""
    settings = Settings(data=tmp_path_factory.mktemp("preflight"), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as one:
        yield one


def tripping() -> dict[str, Any]:
    """A plan whose second station trips early."""
    data = plan(duration=8.0)
    data["stations"][1]["limits"]["velocity"] = 0.05
    return data


def test_a_plan_is_simulated_and_nothing_is_stored(running: TestClient) -> None:
    found = running.post(PATH, json={"plan": tripping(), "capacities": [{"force": 1.0e5}]}).json()
    assert found["verdict"] == "trips"
    assert found["trip"]["path"] == "stations.1.limits.velocity"
    assert [use["bound"] for use in found["uses"] if use["against"] == "rig"] == [1.0e5]
    assert running.get("/api/v1/runs").json()["total"] == 0


def test_a_rig_gives_its_capacities(running: TestClient) -> None:
    actuators = [{"name": "North", "stroke": 0.25, "velocity": 0.5}, {"force": 2.0e6}, {"force": 1.0e6}]
    rig = running.post("/api/v1/rigs", json={"name": "Strong wall", "actuators": actuators}).json()["id"]
    found = running.post(PATH, json={"plan": plan(), "rig": rig}).json()
    bounds = {(use["station"], use["quantity"]): use["bound"] for use in found["uses"] if use["against"] == "rig"}
    assert bounds == {(1, "displacement"): 0.25, (1, "velocity"): 0.5, (2, "force"): 2.0e6}
    refused = running.post(PATH, json={"plan": plan(), "rig": "none"}).json()
    assert refused["errors"][0]["where"] == "rig"
    assert running.post(PATH, json={"plan": plan(), "rig": rig, "capacities": [None]}).status_code == 422


def test_a_plan_that_cannot_run_is_refused_at_its_field(running: TestClient) -> None:
    data = plan()
    data["stations"][0]["actuator"]["alpha"] = 0.2
    refused = running.post(PATH, json={"plan": data})
    assert (refused.status_code, refused.json()["errors"][0]["where"]) == (422, "plan.stations.0.actuator.alpha")
    refused = running.post(PATH, json={"plan": plan(), "capacities": [None, None, None]})
    assert refused.json()["errors"][0]["where"] == "capacities"


def test_the_service_answers_while_a_long_plan_is_simulated(running: TestClient) -> None:
    answers: list[Any] = []
    asking = threading.Thread(target=lambda: answers.append(running.post(PATH, json={"plan": plan(duration=1500.0)})))
    asking.start()
    waits = []
    while asking.is_alive():
        begun = time.perf_counter()
        assert running.get("/api/v1/templates/linear-damper").status_code == 200
        waits.append(time.perf_counter() - begun)
    assert max(waits) < 2.0
    found = answers[0].json()
    assert found["verdict"] == "incomplete"
    assert 0 < found["covered_s"] < 1500.0


def test_a_dry_run_beyond_its_bound_is_refused_with_the_bound(running: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(endpoints, "DRY_RUN", replace(DRY_RUN, megabytes=1))
    refused = running.post(PATH, json={"plan": plan(duration=30.0)})
    assert refused.status_code == 422
    assert "needs more than the limit of 1 MB of memory" in refused.json()["detail"]
    assert refused.json()["errors"][0]["fix"].startswith("shorten the test")
    monkeypatch.undo()
    assert running.post(PATH, json={"plan": plan()}).json()["verdict"] == "completes"


def test_the_command_line_says_whether_a_plan_would_trip(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good, bad = tmp_path / "good.yaml", tmp_path / "bad.yaml"
    calm = templates.template("two-storeys").model_copy(update={"duration": 3.0})
    good.write_text(plan_to_yaml(calm))
    bad.write_text(json.dumps(tripping()))
    assert main(["preflight", str(good), "--data", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "Would complete 3 s. Largest use of a limit:" in said
    assert "command velocity" in said and "delay margin" in said
    assert main(["preflight", str(bad), "--json", "--data", str(tmp_path)]) == 1
    assert json.loads(capsys.readouterr().out)["trip"]["station"] == 2
    bad.write_text("schema: rths-plan/1\nnone: 1\n")
    assert main(["preflight", str(bad), "--data", str(tmp_path)]) == 2


def test_a_rig_that_would_refuse_the_plan_decides_the_verdict_with_the_errors_of_a_submission(running: TestClient) -> None:
    for name, actuators, said in (
        ("OneAct", [{}], "the plan has 2 stations, but rig OneAct has 1 actuator."),
        (
            "Weak",
            [{"force": 1.0e3}, {"force": 2.0e3}],
            "exceeds the force of 1 kN of actuator 1 of rig Weak. 1 more in the notes.",
        ),
    ):
        rig = running.post("/api/v1/rigs", json={"name": name, "actuators": actuators}).json()["id"]
        found = running.post(PATH, json={"plan": plan(), "rig": rig}).json()
        assert found["verdict"] == "refused" and found["trip"] is None
        assert said in found["sentence"] and "Without this rig: would complete 2 s." in found["sentence"]
        refused = running.post("/api/v1/runs", json={"plan": plan(), "rig": rig})
        assert refused.status_code == 422
        told = [{"lines": [], **one, "where": one["where"].removeprefix("plan.")} for one in refused.json()["errors"]]
        assert found["refusals"] == told
    assert "of actuator 2 of rig Weak" in found["notes"][0]


@pytest.mark.parametrize(
    ("given", "where", "problem"),
    [
        ('"rgi": "x"', "rgi", "is not a field of this request"),
        ('"capacities": [{"farce": 1}]', "capacities.0.farce", "is not a field of this request"),
        ('"capacities": [{"force": Infinity}]', "capacities.0.force", "finite number"),
    ],
)
def test_a_misspelt_field_and_an_infinite_capacity_are_refused(
    running: TestClient, given: str, where: str, problem: str
) -> None:
    body = f'{{"plan": {json.dumps(plan())}, {given}}}'
    refused = running.post(PATH, content=body, headers={"Content-Type": "application/json"})
    (error,) = refused.json()["errors"]
    assert (refused.status_code, error["where"]) == (422, where) and problem in error["problem"]


def test_a_delay_is_identified_and_the_plan_stays_as_it_was(running: TestClient) -> None:
    data = plan()
    found = running.post("/api/v1/plans/identify", json={"plan": data, "station": 2, "seconds": 5.0}).json()
    alpha = next(one for one in found["models"] if one["kind"] == "first_order")["parameters"][0]
    assert alpha["value"] == pytest.approx(data["stations"][1]["actuator"]["alpha"], rel=0.01)
    assert found["suggested"][0]["path"] == "stations.1.compensator.alpha_es"
    assert running.get("/api/v1/runs").json()["total"] == 0


def test_an_identification_beyond_its_bound_names_its_command(running: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(endpoints, "IDENTIFICATION", replace(IDENTIFICATION, megabytes=1))
    refused = running.post("/api/v1/plans/identify", json={"plan": plan(), "seconds": 5.0})
    assert refused.status_code == 422
    assert "the identification needs more than the limit of 1 MB of memory" in refused.json()["detail"]
    assert "`rths identify PLAN`" in refused.json()["errors"][0]["fix"]


def test_an_identification_names_the_field_that_is_wrong(running: TestClient) -> None:
    refused = running.post("/api/v1/plans/identify", json={"plan": plan(), "station": 9, "seconds": 5.0})
    assert (refused.status_code, refused.json()["errors"][0]["where"]) == (422, "station")
    narrow = {"plan": plan(), "low_frequency": 4.0, "high_frequency": 5.0}
    assert running.post("/api/v1/plans/identify", json=narrow).status_code == 422
    for wrong in ({"amplitude": 1e-300}, {"station": True}):
        answer = running.post("/api/v1/plans/identify", json={"plan": plan(), **wrong})
        assert (answer.status_code, [error["where"] for error in answer.json()["errors"]]) == (422, list(wrong))


def test_the_command_prints_the_delay_with_its_interval(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "plan.yaml"
    path.write_text(plan_to_yaml(templates.template("linear-damper")), encoding="utf-8")
    assert main(["identify", str(path), "--seconds", "5"]) == 0
    said = capsys.readouterr().out
    assert "95 % interval" in said and "stations.0.compensator.alpha_es: " in said
    assert main(["identify", str(path), "--seconds", "5", "--amplitude", "9 m"]) == 2
