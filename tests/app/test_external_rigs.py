"""Plans with external rigs in the service: which rig takes them, what a dead worker leaves, and what people read."""

from __future__ import annotations

import json
import re
import socket
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.cli.main import main
from app.config import Settings
from app.jobs.service import JobService
from app.jobs.states import State
from app.models import Run
from app.reports.document import Facts
from app.reports.of_run import repeating
from app.reports.record_of_test import record
from app.runs.job import RUNS
from app.runs.order import WAITING, RunOrder
from app.worker import client as client_worker
from app.worker import engine
from rths_engine.foundation.errors import PlanError
from rths_engine.planning.reading import plan_to_yaml
from rths_engine.preflight import preflight
from rths_engine.recordings.run_file import load
from rths_engine.stability import summary
from rths_engine.sweeps.design import read_design
from rths_engine.wire.generic import Action, Numbers, Request, Sizes, pack_request, pack_sizes
from tests.engine.clients import led
from tests.engine.clients import station as rig_of_client
from tests.engine.external_plans import hybrid, station
from tests.engine.generic_server import serving

LIMITS = {"displacement": 0.03, "velocity": 0.3, "force": 5e5}


def plan(port: int = 8090, **more: Any) -> Any:
    return hybrid(station(1, {"kind": "generic_client", "port": port, **more}, limits=LIMITS), station(2, limits=LIMITS))


def physical(client: TestClient) -> str:
    actuator = {"stroke": 0.5, "velocity": 1.0, "force": 1e6}
    given = {"name": "Wall", "kind": "physical", "actuators": [actuator, actuator]}
    rig: str = client.post("/api/v1/rigs", json=given).raise_for_status().json()["id"]
    return rig


def test_a_machine_is_driven_only_on_a_physical_rig(client: TestClient) -> None:
    answer = client.post("/api/v1/runs", json={"plan": plan().as_dict()})
    (error,) = answer.json()["errors"]
    assert answer.status_code == 422 and error["where"] == "stations.0.connection"
    assert (
        "generic server 127.0.0.1:8090 (TCP), which can be a machine, but rig Emulated laboratory is emulated"
        in error["problem"]
    )
    assert "physical rig" in error["fix"]
    sent = client.post("/api/v1/runs", json={"plan": plan().as_dict(), "rig": physical(client)}).raise_for_status()
    run = client.get(f"/api/v1/runs/{sent.json()['runs'][0]['id']}").json()
    assert run["external"] == ["Station 1 (Spring 1) is external: generic server 127.0.0.1:8090 (TCP)."]


FAST = {"kind": "real_time", "factor": 2.0}


def test_a_machine_is_never_moved_faster_than_its_limits_say(
    client: TestClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By submission, preflight, check and command line."""
    data = {**plan().as_dict(), "pace": FAST}
    given = {"plan": data, "rig": physical(client)}
    for path, body in (("runs", given), ("plans/preflight", given), ("plans/check", data)):
        answer = client.post(f"/api/v1/{path}", json=body)
        (error,) = answer.json()["errors"]
        assert (answer.status_code, error["where"].removeprefix("plan."), error["value"]) == (422, "pace.factor", "2.0")
        assert "the rig of station 1 (Spring 1) faster than the velocity limit" in error["problem"]
        assert "lower the speed factor to 1" in error["fix"]
    (tmp_path / "plan.json").write_text(json.dumps(data))
    assert main(["run", str(tmp_path / "plan.json")]) == 2
    assert "pace.factor = 2" in capsys.readouterr().err


def test_a_physical_rig_refuses_a_plan_faster_than_real_time(client: TestClient) -> None:
    data, rig = hybrid(station(1, limits=LIMITS)).as_dict(), physical(client)
    given = {"plan": {**data, "pace": FAST}, "rig": rig}
    (error,) = client.post("/api/v1/runs", json=given).json()["errors"]
    assert error["where"] == "pace.factor" and "moves rig Wall faster" in error["problem"]
    found = client.post("/api/v1/plans/preflight", json=given).json()
    assert found["verdict"] == "refused" and "the speed factor, 2, moves rig Wall faster" in found["sentence"]
    slower = {"plan": {**data, "pace": {"kind": "real_time", "factor": 0.5}}, "rig": rig}
    client.post("/api/v1/runs", json=slower).raise_for_status()


def test_an_fmu_needs_no_physical_rig(client: TestClient) -> None:
    given = hybrid(station(1, {"kind": "fmu", "path": "rig.fmu"}, limits=LIMITS))
    client.post("/api/v1/runs", json={"plan": given.as_dict()}).raise_for_status()


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    made = db.connect(settings.url)
    yield db.sessions(made)
    made.dispose()


def test_a_test_whose_worker_died_is_not_started_again(client: TestClient, maker: sessionmaker[Session]) -> None:
    sent = client.post("/api/v1/runs", json={"plan": plan().as_dict(), "rig": physical(client)}).raise_for_status()
    run_id = sent.json()["runs"][0]["id"]
    for _ in range(2):
        with db.unit_of_work(maker) as session:
            taken: Any = JobService[Run, Any](session, RUNS).start(run_id, "worker")
    assert taken.started is None
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert (run["state"], run["attempt"]) == (State.FAILED, 1)
    assert run["reason"] == (
        "The worker or the process of the test died. The test drove an external rig (generic server 127.0.0.1:8090 (TCP)), "
        "so it is not started again by itself. Inspect the rig, then retry."
    )


@pytest.mark.parametrize(("doing", "again"), [("waiting for client at 127.0.0.1:8090 by TCP", True), ("at 0.4 s", False)])
def test_a_test_whose_client_had_connected_is_not_started_again(
    client: TestClient, maker: sessionmaker[Session], doing: str, again: bool
) -> None:
    given = led([rig_of_client()]).model_dump(mode="json", by_alias=True)
    run_id = client.post("/api/v1/runs", json={"plan": given}).raise_for_status().json()["runs"][0]["id"]
    for attempt in (1, 2):
        with db.unit_of_work(maker) as session:
            jobs = JobService[Run, Any](session, RUNS)
            taken: Any = jobs.start(run_id, "worker")
            if attempt == 1:
                jobs.progress(run_id, 1, doing, 0.0)
    assert (taken.started is not None) is again
    run = client.get(f"/api/v1/runs/{run_id}").json()
    assert run["state"] == (State.RUNNING if again else State.FAILED)
    assert again or "Its client had connected, so the test is not started again by itself." in run["reason"]


class Line:
    """The process' line to its worker; the test is cancelled after some looks."""

    def __init__(self, looks: int = 10**9):
        self.looks = looks

    def cancelled(self, within_s: float = 0.0) -> bool:
        self.looks -= 1
        return self.looks < 0

    def show(self, message: Any) -> None: ...

    def progress(self, doing: str, share: float) -> None: ...

    def stopping(self) -> None: ...


@pytest.mark.parametrize(
    ("ends", "looks", "status"), [({}, 10**9, "completed"), ({}, 1, "cancelled"), ({60: "silent"}, 10**9, "tripped")]
)
def test_every_end_in_the_worker_is_recorded_and_the_rig_holds(tmp_path: Path, ends: Any, looks: int, status: str) -> None:
    with serving(2.0, ends=ends) as server:
        given = plan(server.port, patience=0.2)
        order = RunOrder("run", 1, given.as_dict(), tmp_path / "run.h5", Settings(data=tmp_path))
        outcome = engine.execute(order, Line(looks))  # type: ignore[arg-type]
    recording = load(tmp_path / "run.h5")
    assert outcome.summary["status"] == recording.status == status
    assert server.asked[-2:] == [Action.SET_TRIAL, Action.END]
    facts = record({}, recording)[0]
    assert isinstance(facts, Facts)
    said = {name: text for name, text in facts.rows}
    assert "only as far as their rigs repeat" in repeating(recording)
    assert said["External stations"].startswith("Station 1 (Spring 1) is external: generic server")
    assert ("lost its rig" in said["Trip"]) is (status == "tripped")


class Jumper(Line):
    """A line whose other end connects to the rig that waits, and jumps far at once."""

    def progress(self, doing: str, share: float) -> None:
        if doing.startswith(WAITING):
            threading.Thread(target=self._jump, args=(int(re.findall(r":(\d+)", doing)[0]),)).start()

    def _jump(self, port: int) -> None:
        with socket.create_connection(("127.0.0.1", port)) as line:
            none = (0.0,)
            line.sendall(pack_sizes(Sizes(Numbers(1, 1, 1, 0, 1), Numbers(force=1), 16)))
            for displacement, time in ((0.0, 0.0), (1.0, 0.01)):
                line.sendall(pack_request(Request(Action.SET_TRIAL, (displacement,), none, none, time), 16))
            while line.recv(4096):
                line.sendall(pack_request(Request(Action.END, none, none, none), 16))


def test_a_limit_that_trips_in_the_first_controller_step_is_stored_as_a_trip(tmp_path: Path) -> None:
    given = led([rig_of_client()]).model_dump(mode="json", by_alias=True)
    outcome = client_worker.execute(RunOrder("run", 1, given, tmp_path / "run.h5", Settings(data=tmp_path)), Jumper())  # type: ignore[arg-type]
    recording = load(tmp_path / "run.h5")
    assert outcome.summary["status"] == recording.status == "tripped" and outcome.summary["simulated_s"] == 0
    facts = record({}, recording)[0]
    assert isinstance(facts, Facts)
    assert ("Trip", outcome.summary["trip"]["sentence"]) in [(name, text) for name, text in facts.rows]
    assert "was 100000.0 mm/s, beyond its limit of 500 mm/s" in outcome.summary["trip"]["sentence"]


def test_a_rig_that_does_not_answer_refuses_the_test(tmp_path: Path) -> None:
    from app.worker.child import Refused

    with serving(2.0) as server:
        order = RunOrder("run", 1, plan(server.port).as_dict(), tmp_path / "run.h5", Settings(data=tmp_path))
        engine.execute(order, Line())  # type: ignore[arg-type]
    with pytest.raises(Refused, match="does not answer: Connection refused"):
        engine.execute(order, Line())  # type: ignore[arg-type]


def test_the_command_line_drives_a_rig(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with serving(2.0) as server:
        (tmp_path / "plan.yaml").write_text(plan_to_yaml(plan(server.port)))
        code = main(["run", str(tmp_path / "plan.yaml"), "--json", "--out", str(tmp_path / "run.h5")])
    assert code == 0 and json.loads(capsys.readouterr().out)["status"] == "completed"
    assert main(["run", str(tmp_path / "plan.yaml")]) == 2
    assert "does not answer: Connection refused" in capsys.readouterr().err


def test_predictions_use_the_models_and_say_so() -> None:
    """No server listens: a prediction that asked the rig would fail."""
    note = "Station 1 (Spring 1) is an external rig. This prediction uses the models of the plan; no rig was moved or asked."
    found = preflight(plan())
    assert found["verdict"] == "completes" and found["notes"][0] == note
    assert note in summary(plan())["notes"]


def test_a_sweep_refuses_external_rigs() -> None:
    definition = {"plan": plan().as_dict(), "fields": [{"path": "stations.1.specimen.stiffness", "values": [1e6, 2e6]}]}
    with pytest.raises(PlanError, match=r"plan\.stations\.0\.connection: is an external rig"):
        read_design(definition)
