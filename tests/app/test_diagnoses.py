"""Diagnoses in a whole service: queued, told of, cancelled, taken up again, stored once; and the extended plan run."""

from __future__ import annotations

import json
import os
import signal
from typing import Any

import pytest

from tests.app.test_cli_diagnose import plan as specimen
from tests.app.test_worker import processes
from tests.browser.service import Service, until

ENDED = {"completed", "cancelled", "failed"}
PATIENCE_S = 180  # two busy cores
OTHER = {"drive": {"amplitude": 0.01, "shape": {"kind": "sine"}}}  # another motion than the recorded one
LEFT_OUT = [{"kind": "backlash", "gap": 0.002}]


def plan(**more: Any) -> dict[str, Any]:
    """Half the samples of the command line's specimen."""
    return specimen(**more).model_copy(update={"controller_rate": 256.0}).as_dict()


@pytest.fixture(scope="module")
def played(service: Service) -> str:
    """A run whose specimen has play."""
    run: str = service.post("/runs", {"plan": plan(specimen_physics=LEFT_OUT)})["runs"][0]["id"]
    service.wait(run, "completed", within_s=PATIENCE_S)
    return run


@pytest.fixture(scope="module")
def long(service: Service) -> dict[str, Any]:
    """What is asked to diagnose a test so long that it can be stopped on the way."""
    shape = {"kind": "band_noise", "low_frequency": 0.1, "high_frequency": 2.0, "duration": 40.0}
    driven = {"drive": {"amplitude": 0.03, "shape": shape}}
    run = service.post("/runs", {"plan": {**plan(specimen_physics=LEFT_OUT), **driven}})["runs"][0]["id"]
    service.wait(run, "completed", within_s=PATIENCE_S)
    return {"run": run, "plan": {**plan(), **driven}}


def ask(service: Service, run: str, **more: Any) -> str:
    asked = {"recording": {"run": run}, "plan": plan(), "submitted_by": "Ana Ruiz", **more}
    diagnosis: str = service.post("/diagnoses", asked)["id"]
    return diagnosis


def until_state(service: Service, diagnosis: str, *states: str) -> dict[str, Any]:
    found: dict[str, Any] = until(
        lambda: service.get(f"/diagnoses/{diagnosis}"), lambda one: one["state"] in ENDED.union(states), PATIENCE_S
    )
    assert found["state"] in states, found["reason"]
    return found


def files(service: Service) -> set[str]:
    folders = (service.data / name for name in ("recordings", "measured"))
    return {str(path) for folder in folders for path in folder.rglob("*")}


@pytest.fixture(scope="module")
def diagnosed(service: Service, played: str) -> dict[str, Any]:
    return until_state(service, ask(service, played, name="Worn damper", plan={**plan(), **OTHER}), "completed")


def test_play_that_the_plan_leaves_out_is_named_and_stored_with_its_pictures(
    service: Service, played: str, diagnosed: dict[str, Any]
) -> None:
    path = f"/diagnoses/{diagnosed['id']}"
    assert (diagnosed["share"], diagnosed["found"], diagnosed["attempt"]) == (1.0, "mismatch", 1)
    assert diagnosed["recording"]["run_id"] == played and diagnosed["name"] == "Worn damper"
    verdict = service.get(f"{path}/verdict.json")
    assert verdict == diagnosed["verdict"] and verdict["schema"] == "rths-diagnosis/1"
    assert [(one["component"], one["id"]) for one in verdict["effects"]] == [("specimen:1", "backlash")]
    assert diagnosed["sentence"] == verdict["effects"][0]["sentence"]
    pictures = service.get(f"{path}/pictures.json")
    assert [one["component"] for one in pictures["components"]] == [
        one["component"] for one in verdict["components"] if one["verdict"] != "configuration_error"
    ]
    text = service.http.get(f"/api/v1{path}/report.html").text
    assert "backlash was left out" in text and diagnosed["id"] in text and "NaN" not in json.dumps([verdict, pictures])
    assert [one["id"] for one in service.get("/diagnoses?limit=500")["diagnoses"]].count(diagnosed["id"]) == 1


def test_the_extended_plan_and_the_plan_are_queued_once_as_ordinary_runs_under_the_recorded_motion(
    service: Service, diagnosed: dict[str, Any]
) -> None:
    path = f"/diagnoses/{diagnosed['id']}"
    runs = service.post(f"{path}/simulations", {"by": "Bo"})
    again = service.http.post(f"/api/v1{path}/simulations", json={})
    assert again.status_code == 409 and "already been queued" in again.json()["detail"]
    for word in ("before", "after"):
        run = service.wait(runs[word]["id"], "completed", within_s=PATIENCE_S)
        assert service.get(path)[f"{word}_id"] == run["id"] and run["name"].endswith(f", {word} diagnosis")
        assert [one["kind"] for one in run["plan"]["stations"][0]["specimen_physics"]] == (
            ["backlash"] if word == "after" else []
        )
        assert run["plan"]["drive"]["shape"]["kind"] == "samples"


def test_a_run_is_diagnosed_by_a_linear_model_that_is_fitted_to_it(service: Service, played: str) -> None:
    diagnosis = ask(service, played, plan=None, linear=True)
    assert service.get(f"/diagnoses/{diagnosis}")["plan"]["fitted"] == "linear"
    found = until_state(service, diagnosis, "completed")
    assert found["found"] == "mismatch" and found["plan"]["name"].startswith("Linear model fitted to")
    specimen = found["plan"]["stations"][0]["specimen"]
    assert specimen["kind"] == "linear" and 1e6 < specimen["stiffness"] < 3e6


def test_a_cancelled_diagnosis_leaves_nothing_behind(service: Service, long: dict[str, Any]) -> None:
    before, engines = files(service), set(processes(service, "spawn_main"))
    diagnosis = ask(service, **long)
    until(lambda: service.get(f"/diagnoses/{diagnosis}"), lambda one: one["share"] > 0, PATIENCE_S)
    service.post(f"/diagnoses/{diagnosis}/cancel", {"by": "Bo"})
    found = until_state(service, diagnosis, "cancelled")
    assert "Bo" in found["reason"] and found["verdict"] is None and found["doing"] == ""
    until(lambda: set(processes(service, "spawn_main")), lambda left: left <= engines)
    assert files(service) == before
    for name in ("verdict.json", "pictures.json", "report.html"):
        answer = service.http.get(f"/api/v1/diagnoses/{diagnosis}/{name}")
        assert answer.status_code == 409 and "has no result" in answer.json()["detail"]
    assert service.http.delete(f"/api/v1/diagnoses/{diagnosis}").status_code == 204
    assert service.http.get(f"/api/v1/diagnoses/{diagnosis}").status_code == 404


def test_a_diagnosis_whose_worker_is_killed_is_done_again_and_stored_once(service: Service, long: dict[str, Any]) -> None:
    diagnosis = ask(service, **long)
    until(lambda: service.get(f"/diagnoses/{diagnosis}"), lambda one: one["share"] > 0, PATIENCE_S)
    (worker,) = processes(service, "app.worker")
    os.kill(worker, signal.SIGKILL)
    found = until_state(service, diagnosis, "completed")
    assert found["attempt"] == 2 and found["found"] == "mismatch"
    assert [one["id"] for one in service.get("/diagnoses?limit=500")["diagnoses"]].count(diagnosis) == 1


def test_a_recording_that_is_not_of_the_plan_ends_with_the_reason(service: Service, played: str) -> None:
    slow = {**plan(), "controller_rate": 128.0}
    found = until_state(service, ask(service, played, plan=slow), "failed")
    assert "has a sampling rate of 256 Hz; the controller rate of the plan is 128 Hz" in found["reason"]
    assert found["reason"].startswith("The recording:") and found["verdict"] is None
