"""What can't be diagnosed is refused with the reason, and what a worker may do with a diagnosis has rules."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.diagnoses.job import DIAGNOSES
from app.diagnoses.order import Diagnosed
from app.jobs.service import MOST_ATTEMPTS, JobService
from rths_engine.diagnosis.schema import Pictures, Verdict
from tests.app import test_recordings_api as recordings
from tests.app.conftest import app_of
from tests.app.conftest import plan as hybrid
from tests.app.test_cli_diagnose import plan as specimen

URL = "/api/v1/diagnoses"
VERDICT: dict[str, Any] = {
    "schema": "rths-diagnosis/1", "verdict": "consistent", "components": [], "where": None, "effects": [], "candidates": [],
    "indistinguishable": [], "fit": {"baseline": {"fit_nrmse": 0.01, "heldout_nrmse": 0.01},
    "extended": {"fit_nrmse": 0.01, "heldout_nrmse": 0.01}, "noise_floor_nrmse": 0.01},
    "unexplained": {"fraction": 0.0, "formula": None, "words": "Noise."}, "next_test": None, "extended_plan": None,
}  # fmt: skip
PICTURES: dict[str, Any] = {"schema": "rths-diagnosis-pictures/1", "components": []}
RESULT = Diagnosed(specimen().as_dict(), Verdict.read(VERDICT), Pictures.read(PICTURES))


@pytest.fixture
def recording(client: TestClient) -> str:
    found: str = recordings.add(client, test="specimen")["id"]
    return found


@pytest.fixture(scope="module")
def imported(serving: TestClient) -> str:
    """A recording of the service that all refusals share."""
    found: str = recordings.add(serving, test="specimen")["id"]
    return found


def asked(recording: str, **more: Any) -> dict[str, Any]:
    return {"recording": {"recording": recording}, "plan": specimen().as_dict(), **more}


def queued(client: TestClient, recording: str, **more: Any) -> dict[str, Any]:
    answer = client.post(URL, json=asked(recording, **more))
    assert answer.status_code == 201, answer.text
    found: dict[str, Any] = answer.json()
    return found


@pytest.mark.parametrize(
    ("changes", "status", "told"),
    [
        ({"plan": None}, 422, "is required: an imported recording has no plan"),
        ({"template": "two-storeys"}, 422, "is given 2 times"),
        ({"plan": {"test": "specimen", "stations": []}}, 422, "stations"),
        ({"plan": None, "template": "two-actuators"}, 422, "has stations that share a specimen"),
        ({"plan": "test: [specimen"}, 422, "line"),
        ({"plan": "name: \ud800"}, 422, ""),
        ({"plan": None, "template": "table3-99"}, 404, "There is no template 'table3-99'"),
        ({"plan": None, "plan_of_run": "nobody"}, 404, "There is no run nobody"),
        ({"plan": None, "extended_plan_of": "nobody"}, 404, "There is no diagnosis nobody"),
        ({"linear": True}, 422, "is given 2 times"),
        ({"plan": hybrid()}, 422, "is of a 'specimen' test; the plan describes a 'hybrid' test"),
        ({"recording": {}}, 422, "needs exactly one of recording and run"),
        ({"recording": {"recording": "a", "run": "b"}}, 422, "needs exactly one of recording and run"),
        ({"recording": {"recording": "nobody"}}, 404, "There is no recording nobody"),
        ({"recording": {"run": "nobody"}}, 404, "There is no run nobody"),
        ({"heldout": [{"recording": "nobody"}]}, 404, "There is no recording nobody"),
        ({"heldout": [{}]}, 422, "heldout.0"),
        ({"level": 0}, 422, "level"),
        ({"level": "often"}, 422, "level"),
        ({"name": "a\x00b"}, 422, "name"),
        ({"colour": "red"}, 422, "colour"),
    ],
)
def test_what_cant_be_diagnosed_is_refused_and_nothing_stored(
    serving: TestClient, imported: str, changes: dict[str, Any], status: int, told: str
) -> None:
    body = json.dumps({**asked(imported), **changes})  # ASCII, which carries half of a surrogate pair too
    answer = serving.post(URL, content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert told in answer.text
    assert serving.get(URL).json() == {"diagnoses": [], "total": 0}


@pytest.mark.parametrize(("changes", "where"), [({"plan": 4}, "plan"), ({"recording": {"run": [1]}}, "recording.run")])
def test_a_field_that_can_be_of_two_types_is_named_without_them(
    client: TestClient, recording: str, changes: dict[str, Any], where: str
) -> None:
    errors = client.post(URL, json={**asked(recording), **changes}).json()["errors"]
    assert {one["where"] for one in errors} == {where}


def test_a_run_without_recording_cant_be_diagnosed(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": hybrid()}).json()["runs"][0]["id"]
    answer = client.post(URL, json={"recording": {"run": run}})
    assert answer.status_code == 409 and "has no recording: its status is queued" in answer.json()["detail"]


@pytest.mark.parametrize("path", ["", "/verdict.json", "/pictures.json", "/report.html"])
def test_an_unknown_diagnosis_is_not_found(serving: TestClient, path: str) -> None:
    answer = serving.get(f"{URL}/nobody{path}")
    assert answer.status_code == 404 and answer.json()["detail"] == "There is no diagnosis nobody."


def test_a_queued_diagnosis_is_cancelled_at_once_and_then_removed(client: TestClient, recording: str) -> None:
    one = queued(client, recording, submitted_by="Ana", heldout=[{"recording": recording}])
    assert (one["state"], one["share"], one["submitted_by"]) == ("queued", 0.0, "Ana")
    assert [held["recording_id"] for held in one["heldout"]] == [recording]
    path = f"{URL}/{one['id']}"
    refused = client.delete(path)
    assert refused.status_code == 409 and "Cancel it first" in refused.json()["detail"]
    cancelled = client.post(f"{path}/cancel", json={"by": "Bo"}).json()
    assert cancelled["state"] == "cancelled" and cancelled["reason"] == "Cancelled by Bo before it started."
    assert client.post(f"{path}/cancel").status_code == 409
    assert client.post(f"{path}/simulations").status_code == 409
    assert client.delete(path).status_code == 204
    assert client.delete(path).status_code == 404


def test_a_recording_stays_while_a_diagnosis_refers_to_it(client: TestClient, recording: str) -> None:
    one = queued(client, recording)
    client.post(f"{URL}/{one['id']}/cancel")
    refused = client.delete(f"{recordings.URL}/{recording}")
    assert refused.status_code == 409 and "1 × diagnosis input" in refused.json()["detail"]
    client.delete(f"{URL}/{one['id']}")
    assert client.delete(f"{recordings.URL}/{recording}").status_code == 204


class Bench:
    """A queued diagnosis, seen by its worker and by people."""

    def __init__(self, client: TestClient, maker: sessionmaker[Session], diagnosis: str):
        self.client, self.maker, self.diagnosis = client, maker, diagnosis

    def do(self, name: str, *given: Any) -> Any:
        with db.unit_of_work(self.maker) as session:
            return getattr(JobService(session, DIAGNOSES), name)(self.diagnosis, *given)

    @property
    def seen(self) -> dict[str, Any]:
        found: dict[str, Any] = self.client.get(f"{URL}/{self.diagnosis}").json()
        return found


@pytest.fixture
def bench(client: TestClient, settings: Settings, recording: str) -> Bench:
    return Bench(client, app_of(client).state.sessions, queued(client, recording)["id"])


def test_a_result_is_stored_once_whatever_attempt_comes_late(bench: Bench) -> None:
    bench.do("start", "first")
    bench.do("start", "second")
    bench.do("progress", 1, "too late", 0.9)
    bench.do("finish", 1, RESULT)
    assert (bench.seen["state"], bench.seen["attempt"], bench.seen["share"]) == ("running", 2, 0.0)
    bench.do("finish", 2, RESULT)
    bench.do("fail", 2, "too late")
    assert (bench.seen["state"], bench.seen["verdict"]) == ("completed", RESULT.verdict.as_dict())
    assert bench.seen["sentence"] == "The recording agrees with the plan's models up to noise."
    assert bench.do("start", "third").started is None


def test_a_result_that_comes_after_its_cancel_is_not_kept(bench: Bench) -> None:
    bench.do("start", "here")
    bench.client.post(f"{URL}/{bench.diagnosis}/cancel", json={"by": "Bo"})
    assert bench.do("to_stop", 1) and bench.seen["state"] == "running"
    bench.do("finish", 1, RESULT)
    assert (bench.seen["state"], bench.seen["verdict"]) == ("cancelled", None)


def test_a_diagnosis_cancelled_while_its_worker_was_dead_is_not_taken_up(bench: Bench) -> None:
    bench.do("start", "dead")
    bench.client.post(f"{URL}/{bench.diagnosis}/cancel", json={"by": "Bo"})
    assert bench.do("start", "here").started is None
    assert bench.seen["state"] == "cancelled" and "Bo" in bench.seen["reason"]


def test_a_diagnosis_that_kills_its_workers_is_given_up(bench: Bench) -> None:
    for _ in range(MOST_ATTEMPTS):
        assert bench.do("start", "doomed").started is not None
    assert bench.do("start", "wiser").started is None
    assert bench.seen["state"] == "failed" and f"died {MOST_ATTEMPTS} times" in bench.seen["reason"]


def test_a_diagnosis_without_an_extended_plan_queues_no_simulation(bench: Bench) -> None:
    bench.do("start", "here")
    bench.do("finish", 1, RESULT)
    answer = bench.client.post(f"{URL}/{bench.diagnosis}/simulations")
    assert answer.status_code == 409 and "no extended plan" in answer.json()["detail"]
    assert bench.client.get("/api/v1/runs").json()["total"] == 0
