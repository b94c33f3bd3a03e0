"""Submitting, listing, cancelling and downloading by REST."""

from __future__ import annotations

import copy
import io
import json
import re
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from app.config import Settings
from app.db import unit_of_work
from app.jobs.service import JobService
from app.jobs.states import TRANSITIONS, IllegalTransition, State, check
from app.npm_parts import PARTS
from app.runs import job
from app.runs.exports import ROWS
from app.runs.order import Outcome
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import plan_from_yaml, read_plan
from rths_engine.recordings import run_file as recording
from rths_engine.running.run import simulate
from tests.app.conftest import ADDRESS, app_of, plan

RUNS = "/api/v1/runs"


def submit(client: TestClient, **changes: Any) -> str:
    answer = client.post(RUNS, json={"plan": plan(**changes), "submitted_by": "Ana"})
    assert answer.status_code == 201, answer.text
    run: str = answer.json()["runs"][0]["id"]
    return run


def execute(client: TestClient, settings: Settings, run_id: str) -> dict[str, Any]:
    """What a worker does, in this process."""
    motions = MotionLibrary(settings.motions)
    with unit_of_work(app_of(client).state.sessions) as session:
        jobs = JobService(session, job.RUNS)
        jobs.get(run_id).priority = 1  # so that it is the next
        run = jobs.start(run_id, "test").started
        assert run is not None and run.id == run_id
        result = simulate(read_plan(run.plan), motions)
    saved = recording.save(settings.recordings / f"{run_id}.h5", result)
    with unit_of_work(app_of(client).state.sessions) as session:
        JobService(session, job.RUNS).finish(run_id, 1, Outcome(result.summary(), saved.sha256, saved.size))
    return result.summary()


def total(client: TestClient) -> int:
    count: int = client.get(RUNS).json()["total"]
    return count


def test_a_plan_is_queued_with_who_when_digest_and_seed(client: TestClient) -> None:
    run = client.get(f"{RUNS}/{submit(client)}").json()
    assert (run["state"], run["submitted_by"], run["seed"], run["template"]) == ("queued", "Ana", 4, "two-storeys")
    assert run["digest"] == read_plan(run["plan"]).digest
    assert datetime.now(UTC) - datetime.fromisoformat(run["submitted_at"]) < timedelta(minutes=1)


def test_the_record_is_pinned_by_its_checksum(client: TestClient) -> None:
    run = client.get(f"{RUNS}/{submit(client)}").json()
    name = run["plan"]["motion"]["record"]
    assert run["plan"]["motion"]["sha256"] == MotionLibrary(None).get(name).sha256


def test_a_list_is_queued_whole_or_not_at_all(client: TestClient) -> None:
    wrong = plan()
    wrong["structure"]["storeys"][1]["mass"] = -1
    answer = client.post(RUNS, json={"plans": [plan(), plan(seed=1), wrong]})
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
    (issue,) = answer.json()["errors"]
    assert (issue["where"], issue["problem"], issue["value"]) == ("plans.2.structure.storeys.1.mass", "needs a value > 0", "-1")
    assert total(client) == 0
    answer = client.post(RUNS, json={"plans": [plan(), plan(seed=1)]})
    assert [run["number"] for run in answer.json()["runs"]] == [1, 2]


@pytest.mark.parametrize(
    ("path", "value", "where", "message"),
    [
        ("structure.storeys.0.mass", -1.0, "structure.storeys.0.mass", "> 0"),
        ("stations.0.actuator.alpha", 0.5, "stations.0.actuator.alpha", ">= 1"),
        ("motion.record", "imperial-valley-1940-el-centre-ns", "motion.record", "el-centro"),
        ("integrator.dt", 0.01, "integrator.dt", "substeps"),
        ("structure.storeys.0.stiffness", 1e-9, "structure", "singular"),
        ("motion", {"kind": "file", "path": "/etc/passwd"}, "motion.kind", "command line"),
    ],
)
def test_a_bad_plan_is_refused_beside_its_field_and_nothing_is_stored(
    serving: TestClient, path: str, value: Any, where: str, message: str
) -> None:
    data = plan()
    inner: Any = data
    *parents, last = path.split(".")
    for step in parents:
        inner = inner[int(step) if step.isdigit() else step]
    inner[last] = value
    answer = serving.post(RUNS, json={"plan": data})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["where"] == where
    assert message in json.dumps(answer.json(), ensure_ascii=False)
    assert total(serving) == 0


def test_a_nan_in_the_motion_is_refused(client: TestClient) -> None:
    data = plan(motion={"kind": "inline", "dt": 0.01, "acceleration": [0.0, 1.0, 0.0]})
    text = json.dumps({"plan": data}).replace("1.0, 0.0]", "NaN, 0.0]")
    answer = client.post(RUNS, content=text, headers={"content-type": "application/json"})
    assert answer.status_code == 422
    assert "finite" in answer.text
    assert total(client) == 0


def test_the_list_filters_sorts_and_pages(client: TestClient, settings: Settings) -> None:
    runs = [submit(client, name=name) for name in ("alpha 100%", "beta", "gamma")]
    execute(client, settings, runs[1])

    def names(**query: Any) -> list[str]:
        return [run["name"] for run in client.get(RUNS, params=query).json()["runs"]]

    assert names() == ["gamma", "beta", "alpha 100%"]
    assert names(sort="name", order="asc", limit=2) == ["alpha 100%", "beta"]
    assert names(sort="name", order="asc", limit=2, offset=2) == ["gamma"]
    assert names(state="completed") == ["beta"]
    assert names(q="%") == ["alpha 100%"]
    assert names(submitted_by="nobody") == []
    assert names(template="two-storeys", sort="mte_mm:1")[0] == "beta"
    assert names(since=(datetime.now(UTC) + timedelta(days=1)).isoformat()) == []
    assert client.get(RUNS, params={"sort": "nonsense"}).status_code == 422
    assert client.get(RUNS, params={"limit": 0}).status_code == 422


def test_a_measure_is_sorted_by_only_at_a_station_that_a_run_has(client: TestClient, settings: Settings) -> None:
    def status(station: int) -> Any:
        return client.get(RUNS, params={"sort": f"mte_mm:{station}"}).status_code

    assert [status(station) for station in (1, 32, 33)] == [200, 200, 422]  # no run yet: what a plan can have
    execute(client, settings, submit(client))
    assert [status(station) for station in (1, 2)] == [200, 200]
    for station in (3, 9, 0, -1, "", "x", "1.0", "٢", "9" * 30):
        answer = client.get(RUNS, params={"sort": f"mte_mm:{station}"})
        assert answer.status_code == 422, station
        assert answer.json()["errors"][0]["where"] == "sort"
        assert "a station number from 1 to 2" in answer.json()["detail"]


@pytest.mark.parametrize(
    ("field", "wrong"),
    [("limit", "0"), ("limit", "501"), ("limit", "x"), ("offset", "-1"), ("offset", "1e3"), ("offset", "9" * 30)],
)
@pytest.mark.parametrize("path", [RUNS, "/api/v1/recordings", "/api/v1/diagnoses"])
def test_a_number_out_of_range_in_a_lists_address_is_refused(serving: TestClient, path: str, field: str, wrong: str) -> None:
    answer = serving.get(path, params={field: wrong})
    assert answer.status_code == 422
    assert [one["where"] for one in answer.json()["errors"]] == [field]


@pytest.mark.parametrize("page", ["0", "-1", "x", "1.5", "9" * 30])
@pytest.mark.parametrize("path", ["/runs", "/recordings", "/diagnoses"])
def test_a_page_of_a_list_that_cant_be_is_refused(serving: TestClient, path: str, page: str) -> None:
    assert serving.get(path, params={"page": page}).status_code == 422


def test_a_finished_run_gives_measures_recording_csv_report_and_plan(client: TestClient, settings: Settings) -> None:
    run_id = submit(client)
    summary = execute(client, settings, run_id)
    run = client.get(f"{RUNS}/{run_id}").json()
    assert run["state"] == "completed"
    assert run["stations"] == summary["stations"]
    assert run["floors_peak_mm"] == summary["floors_peak_mm"]
    assert run["input_energy_kNm"] == summary["input_energy_kNm"] > 0
    hdf5 = client.get(f"{RUNS}/{run_id}/recording.h5")
    assert len(hdf5.content) == run["recording"]["size"]
    assert hdf5.headers["etag"] == f'"{run["recording"]["sha256"]}"'
    lines = client.get(f"{RUNS}/{run_id}/recording.csv").text.splitlines()
    assert lines[0].startswith("t (s),ag (g),x_floor.1 (mm),x_floor.2 (mm),x_cmd.1 (mm)")
    assert len(lines) == 1 + 2050  # 205 integration steps cover 2 s
    assert float(lines[1].split(",")[0]) == pytest.approx(1 / 1024)
    assert "<html" in client.get(f"{RUNS}/{run_id}/report.html").text
    assert plan_from_yaml(client.get(f"{RUNS}/{run_id}/plan.yaml").text) == read_plan(run["plan"])


def test_a_csv_is_the_recording_in_shown_units_to_its_last_row(client: TestClient, settings: Settings) -> None:
    run_id = submit(client, duration=6.0)
    execute(client, settings, run_id)
    recorded = recording.load(settings.recordings / f"{run_id}.h5")
    assert len(recorded.signals) > ROWS  # more than one part
    text = client.get(f"{RUNS}/{run_id}/recording.csv").text
    table = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1)
    shown = recorded.signals / [channel.factor for channel in recorded.channels]
    assert table[:, 0] == pytest.approx(recorded.time, rel=1e-8)  # 9 digits are written
    assert table[:, 1:] == pytest.approx(shown, rel=1e-8)


def test_a_damaged_recording_is_told_and_not_half_sent(client: TestClient, settings: Settings) -> None:
    run_id = submit(client)
    execute(client, settings, run_id)
    path = settings.recordings / f"{run_id}.h5"
    path.write_bytes(path.read_bytes()[:2000])
    for name in ("recording.csv", "report.html"):
        answer = client.get(f"{RUNS}/{run_id}/{name}")
        assert (answer.status_code, answer.headers["content-type"]) == (409, "application/problem+json")
        assert run_id in answer.json()["detail"]
    path.unlink()
    assert "missing" in client.get(f"{RUNS}/{run_id}/recording.h5").json()["detail"]


def test_a_list_does_not_carry_the_plans(client: TestClient) -> None:
    run_id = submit(client)
    assert "plan" not in client.get(RUNS).json()["runs"][0]
    assert client.get(f"{RUNS}/{run_id}").json()["plan"]["name"]


def test_runs_without_a_measure_come_after_those_with_one(client: TestClient, settings: Settings) -> None:
    done, waiting = submit(client), submit(client)
    execute(client, settings, done)
    for order in ("asc", "desc"):
        for sort in ("mte_mm:1", "fei_delay_ms:2", "finished_at"):
            found = client.get(RUNS, params={"sort": sort, "order": order}).json()["runs"]
            assert [run["id"] for run in found] == [done, waiting]


def test_a_run_without_recording_says_so(client: TestClient) -> None:
    run_id = submit(client)
    for name in ("recording.h5", "recording.csv", "report.html"):
        answer = client.get(f"{RUNS}/{run_id}/{name}")
        assert answer.status_code == 409
        assert "queued" in answer.json()["detail"]


def test_a_second_finish_changes_nothing(client: TestClient, settings: Settings) -> None:
    run_id = submit(client)
    summary = execute(client, settings, run_id)
    with unit_of_work(app_of(client).state.sessions) as session:
        service = JobService(session, job.RUNS)
        assert service.start(run_id, "other").started is None
        assert service.finish(run_id, 1, Outcome({**summary, "status": "tripped"}, "0" * 64, 1)) is False
    assert client.get(f"{RUNS}/{run_id}").json()["state"] == "completed"


def test_a_run_that_kills_its_worker_is_parked_after_three_attempts(client: TestClient) -> None:
    run_id = submit(client)
    for attempt in (1, 2, 3):
        with unit_of_work(app_of(client).state.sessions) as session:
            run = JobService(session, job.RUNS).start(run_id, "dying").started
            assert run is not None and run.attempt == attempt
    with unit_of_work(app_of(client).state.sessions) as session:
        assert JobService(session, job.RUNS).start(run_id, "dying").started is None
    run = client.get(f"{RUNS}/{run_id}").json()
    assert run["state"] == "failed" and "3 times" in run["reason"]


def test_a_queued_run_is_cancelled_at_once_and_only_once(client: TestClient) -> None:
    run_id = submit(client)
    assert client.post(f"{RUNS}/{run_id}/cancel", json={"by": "Bo"}).json()["state"] == "cancelled"
    answer = client.post(f"{RUNS}/{run_id}/cancel")
    assert answer.status_code == 409
    assert "cancelled" in answer.json()["detail"]


def test_abort_holds_the_queue_until_it_is_released(client: TestClient) -> None:
    client.post("/api/v1/abort", json={"by": "Bo"})
    queue = client.get("/api/v1/queue").json()
    assert (queue["held"], queue["held_by"]) == (True, "Bo")
    assert client.post("/api/v1/queue/release").json()["held"] is False


@pytest.mark.parametrize(
    "path", [f"{RUNS}/none", f"{RUNS}/none/recording.h5", "/api/v1/templates/none", "/api/v1/motions/none"]
)
def test_what_does_not_exist_is_a_404_problem(serving: TestClient, path: str) -> None:
    answer = serving.get(path)
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("old", list(State))
@pytest.mark.parametrize("new", list(State))
def test_only_the_table_of_transitions_changes_a_state(old: State, new: State) -> None:
    if new in TRANSITIONS[old]:
        check(old, new)
    else:
        with pytest.raises(IllegalTransition):
            check(old, new)


def test_a_large_body_is_refused_by_its_declared_and_by_its_counted_length(client: TestClient) -> None:
    answer = client.post(RUNS, content=b"x", headers={"content-length": "2000000000"})
    assert (answer.status_code, answer.headers["content-type"]) == (413, "application/problem+json")

    def endless() -> Any:
        for _ in range(30):
            yield b" " * 1_000_000

    answer = client.post(RUNS, content=endless(), headers={"content-type": "application/json"})
    assert answer.status_code == 413
    assert "8 MB" in answer.json()["detail"]
    assert answer.headers["content-type"] == "application/problem+json"


def test_another_sites_page_can_change_nothing(client: TestClient) -> None:
    foreign = {"origin": "http://elsewhere.example"}
    assert client.post("/api/v1/abort", headers=foreign).status_code == 403
    assert client.get("/api/v1/queue", headers=foreign).json()["held"] is False
    assert client.post("/api/v1/queue/release", headers={"origin": ADDRESS}).status_code == 200


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=12), inner, max_size=4),
    max_leaves=12,
)
PATHS = ["structure", "stations", "motion", "integrator", "duration", "pace", "seed", "controller_rate", "name", "schema"]


@hypothesis_settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(field=st.sampled_from(PATHS), value=anything, whole=anything)
def test_no_json_causes_a_server_error_or_a_row(client: TestClient, field: str, value: Any, whole: Any) -> None:
    before = total(client)
    broken = copy.deepcopy(plan())
    broken[field] = value
    for body in ({"plan": broken}, {"plan": whole}, whole):
        content = json.dumps(body)
        answer = client.post(RUNS, content=content, headers={"content-type": "application/json"})
        assert answer.status_code in {201, 400, 422}, answer.text
        if answer.status_code != 201:
            assert total(client) == before
        else:
            before += 1


def test_docs_need_nothing_from_elsewhere(client: TestClient) -> None:
    page = client.get("/api/docs").text
    assert "http://" not in page and "https://" not in page
    assets = re.findall(r'(?:src|href)="([^"]+)"', page)
    copied = {f"/static/vendor/{target}" for target in PARTS.values()}  # put there when the program is set up
    assert len(assets) == 3
    assert {asset for asset in assets if client.get(asset).status_code != 200} <= copied
    assert "/api/v1/runs" in client.get("/openapi.json").json()["paths"]
