"""Sweeps by REST, executed here by the functions of the sweep process in place of a worker."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from arro3.io import read_ipc_stream
from fastapi.testclient import TestClient

from app.config import Settings
from app.db import unit_of_work
from app.jobs.service import JobService
from app.jobs.states import State
from app.main import create_app
from app.models import SweepShard
from app.sweeps.job import SHARDS, left
from app.sweeps.order import ShardOrder
from app.sweeps.service import SweepService
from app.worker import sweep as process
from rths_engine.sweeps.columns import columns
from rths_engine.sweeps.design import read_design
from tests.app.conftest import ADDRESS, HERE, app_of, plan

SWEEPS = "/api/v1/sweeps"
ALPHA = "stations.*.compensator.alpha_es"
DAMPING = "structure.damping_ratio"


def definition(**changes: Any) -> dict[str, Any]:
    """Four short points: the first column trips at once where the limit is tiny."""
    fields = [{"path": ALPHA, "values": [20, 30]}, {"path": DAMPING, "values": [1, 5], "unit": "%"}]
    return {"name": "Delay and damping", "plan": plan(duration=0.2), "fields": fields, **changes}


def submit(client: TestClient, **changes: Any) -> str:
    answer = client.post(SWEEPS, json={"sweep": definition(**changes), "submitted_by": "Ana"})
    assert answer.status_code == 201, answer.text
    found: str = answer.json()["id"]
    return found


@pytest.fixture(autouse=True)
def trials(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dry runs that end at once; tests/app/test_preflight_api.py has real ones."""
    monkeypatch.setattr(SweepService, "_trial", lambda *_: 0.5)


def get(client: TestClient, path: str) -> Any:
    answer = client.get(f"{SWEEPS}/{path}")
    assert answer.status_code == 200, answer.text
    return answer.json()


class Line:
    """The line of a process to its worker; the process hears that its job is cancelled when it has asked `most` times."""

    def __init__(self, most: int = 10**9):
        self.parts: list[Any] = []
        self.left = most

    def part(self, result: Any) -> None:
        self.parts.append(result)

    def cancelled(self) -> bool:
        self.left -= 1
        return self.left < 0

    def stopping(self) -> None: ...


def execute(client: TestClient, settings: Settings, shards: int = 10**9) -> None:
    """Execute waiting shards, as a worker and its process do."""
    maker = app_of(client).state.sessions
    with unit_of_work(maker) as session:
        waiting = JobService(session, SHARDS).rows.ids(State.QUEUED)
    for shard in waiting[:shards]:
        with unit_of_work(maker) as session:
            job = JobService(session, SHARDS).start(shard, "here").started
            assert job is not None
            order = SHARDS.order(job, settings)
        sent = Line()
        result = process.execute(order, sent)  # type: ignore[arg-type]
        with unit_of_work(maker) as session:
            jobs: JobService[SweepShard, Any] = JobService(session, SHARDS)
            jobs.keep(shard, order.attempt, sent.parts)
            jobs.finish(shard, order.attempt, result)


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory, migrated: Any) -> Iterator[tuple[TestClient, str]]:
    """A sweep of four points with results, of which two tripped."""
    settings = Settings(data=tmp_path_factory.mktemp("done"), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE) as client:
        fields = [
            {"path": "stations.0.limits.displacement", "values": ["1e-6 mm", "200 mm"]},
            {"path": DAMPING, "values": [0.01, 0.05]},
        ]
        sweep = submit(client, fields=fields)
        execute(client, settings)
        yield client, sweep


def test_a_preview_says_count_axes_columns_stability_and_what_is_not_known(client: TestClient) -> None:
    found = client.post(f"{SWEEPS}/preview", json=definition()).json()
    assert (found["points"], found["examined"], found["all_examined"], found["invalid"]) == (4, 4, True, 0)
    assert [axis["values"] for axis in found["axes"]] == [[20, 30], [1, 5]]
    assert found["axes"][0]["fields"] == ["stations.0.compensator.alpha_es", "stations.1.compensator.alpha_es"]
    prediction = found["stability"]
    assert prediction["predicted"] == 4 == prediction["stable"] + prediction["unstable"]
    assert {"mte_mm.1", "pga_g", "status"} <= {column["key"] for column in found["columns"]}
    duration = found["duration"]
    assert (duration["point_s"], duration["basis"]) == (0.5, "A trial of one point.")
    assert duration["predicted_s"] == 0.5 * -(-4 // duration["processes"])


def test_a_preview_lists_invalid_points_with_inputs_and_reason(client: TestClient) -> None:
    fields = [{"path": "integrator.dt", "values": ["10 ms", 0.009765625]}]
    found = client.post(f"{SWEEPS}/preview", json=definition(fields=fields)).json()
    assert found["invalid"] == 1
    (first,) = found["first_invalid"]
    assert (first["point"], first["inputs"]) == (1, {"integrator.dt": 10.0}) and "controller steps" in first["reason"]


@pytest.mark.parametrize(
    ("changes", "where", "words"),
    [
        ({"fields": [{"path": "structure.dampng", "values": [1]}]}, "fields.0.path", "did you mean damping_ratio?"),
        ({"records": ["el-centro"]}, "records.0", "no record has this name"),
        ({"plan": {"stations": 4}}, "plan.stations", ""),
        ({"fields": [{"path": "integrator.dt", "values": ["10 ms"]}]}, "", "none of the 1 examined points is valid; point 1: "),
        ({"name": "\x00"}, "name", "can't be stored"),
    ],
)
def test_a_sweep_with_an_error_is_refused_with_its_place_and_nothing_is_stored(
    serving: TestClient, changes: dict[str, Any], where: str, words: str
) -> None:
    answer = serving.post(SWEEPS, json={"sweep": definition(**changes)})
    assert answer.status_code == 422
    issue = answer.json()["errors"][0]
    assert issue["where"] == where and words in f"{issue['problem']} {issue['fix']}"
    assert get(serving, "")["total"] == 0


def test_a_queued_sweep_is_listed_with_its_progress(client: TestClient) -> None:
    sweep = submit(client)
    (row,) = get(client, "?limit=5")["sweeps"]
    assert (row["id"], row["state"], row["points"], row["done"], row["share"]) == (sweep, "queued", 4, 0, 0.0)
    detail = get(client, sweep)
    assert detail["sweep"]["plan"]["template"] == "two-storeys"
    assert [one["path"] for one in detail["sweep"]["fields"]] == [ALPHA, DAMPING]
    assert get(client, f"{sweep}/results")["values"]["point"] == []


def test_results_are_columns_in_the_units_shown(done: tuple[TestClient, str]) -> None:
    client, sweep = done
    row = get(client, sweep)
    assert (row["state"], row["done"], row["completed"], row["tripped"]) == ("completed", 4, 2, 2)
    found = get(client, f"{sweep}/results")
    values = found["values"]
    assert values["point"] == [1, 2, 3, 4] and values[DAMPING] == [1.0, 5.0, 1.0, 5.0]
    assert values["stations.0.limits.displacement"] == pytest.approx([1e-6, 1e-6, 200, 200])
    assert values["status"] == ["tripped", "tripped", "completed", "completed"]
    assert values["trip_limit"] == ["displacement", "displacement", None, None]
    assert values["reason"][0].startswith("Tripped at ") and values["reason"][2] is None
    assert values["pga_g"] == pytest.approx([0.2495] * 4, abs=1e-4)
    assert all(len(column) == 4 for column in values.values())
    assert list(values) == ["point", *(column["key"] for column in found["columns"]), "reason"]


def test_results_are_filtered_sorted_and_paged(done: tuple[TestClient, str]) -> None:
    client, sweep = done
    found = get(client, f"{sweep}/results?status=completed&sort={DAMPING}&order=desc&limit=1")
    assert (found["values"]["point"], found["total"], found["points"]) == ([4], 2, 4)
    answer = client.get(f"{SWEEPS}/{sweep}/results?sort=colour")
    assert answer.status_code == 422 and answer.json()["errors"][0]["where"] == "sort"


def test_results_as_csv_and_arrow_are_those_of_json(done: tuple[TestClient, str]) -> None:
    client, sweep = done
    values = get(client, f"{sweep}/results")["values"]
    lines = client.get(f"{SWEEPS}/{sweep}/results?format=csv").text.splitlines()
    assert lines[0].startswith(f"point,stations.0.limits.displacement (mm),{DAMPING} (%),") and len(lines) == 5
    table = read_ipc_stream(io.BytesIO(client.get(f"{SWEEPS}/{sweep}/results?format=arrow").content)).read_all()
    assert table.num_rows == 4 and table["status"].to_pylist() == values["status"]
    assert table["mte_mm.1"].to_pylist() == pytest.approx(values["mte_mm.1"], nan_ok=True)
    declared = json.loads(table.schema.metadata[b"columns"])
    assert [column["key"] for column in declared] == list(values)[1:-1]


def test_a_point_is_an_ordinary_run_on_request(done: tuple[TestClient, str]) -> None:
    client, sweep = done
    point = get(client, f"{sweep}/points/3")
    assert (point["point"], point["inputs"][DAMPING], point["results"]["status"]) == (3, 1.0, "completed")
    run = client.post(f"{SWEEPS}/{sweep}/points/3/run", json={"by": "Bo"}).json()
    stored = client.get(f"/api/v1/runs/{run['id']}").json()
    assert stored["plan"]["structure"]["damping_ratio"] == 0.01
    assert (stored["name"], stored["submitted_by"]) == ("Delay and damping, point 3", "Bo")
    for path in ("points/0", "points/5"):
        assert client.get(f"{SWEEPS}/{sweep}/{path}").status_code == 404


def test_the_time_of_a_sweep_is_predicted_from_the_points_done(done: tuple[TestClient, str]) -> None:
    client, _ = done
    duration = client.post(f"{SWEEPS}/preview", json=definition()).json()["duration"]
    assert duration["predicted_s"] > 0 and "last 4 points" in duration["basis"]


def test_a_cancelled_sweep_keeps_its_points_and_resumes_with_the_others(client: TestClient, settings: Settings) -> None:
    sweep = submit(client)
    execute(client, settings, shards=1)
    assert get(client, sweep)["state"] == "running"
    assert client.post(f"{SWEEPS}/{sweep}/resume", json={}).status_code == 409
    cancelled = client.post(f"{SWEEPS}/{sweep}/cancel", json={"by": "Bo"}).json()
    assert (cancelled["state"], cancelled["done"]) == ("cancelled", 1)
    assert cancelled["reason"] == "Cancelled by Bo. The points done are kept."
    assert client.post(f"{SWEEPS}/{sweep}/cancel", json={}).status_code == 409
    before = get(client, f"{sweep}/results")["values"]
    assert client.post(f"{SWEEPS}/{sweep}/resume", json={}).json()["state"] == "running"
    execute(client, settings)
    after = get(client, f"{sweep}/results")["values"]
    assert get(client, sweep)["state"] == "completed" and after["point"] == [1, 2, 3, 4]
    assert {key: column[:1] for key, column in after.items()} == before  # computing time too: not executed again
    assert client.post(f"{SWEEPS}/{sweep}/resume", json={}).status_code == 409


def test_a_shard_that_starts_again_executes_only_the_points_without_results(client: TestClient, settings: Settings) -> None:
    sweep = submit(client)
    maker = app_of(client).state.sessions
    with unit_of_work(maker) as session:
        jobs: JobService[SweepShard, Any] = JobService(session, SHARDS)
        first, *others = jobs.rows.ids(State.QUEUED)
        for other in others:
            jobs.rows.remove(jobs.locked(other))
        whole = jobs.locked(first)
        whole.count = 4
        order = SHARDS.order(jobs.start(first, "doomed").started or whole, settings)
    part = process._part(process._points(process._Sweep(order)), 1, [process._points(process._Sweep(order)).row(1)])
    with unit_of_work(maker) as session:
        JobService(session, SHARDS).keep(first, order.attempt, [part])
    with unit_of_work(maker) as session:  # another worker takes the shard over
        job = JobService(session, SHARDS).start(first, "second").started
        assert job is not None
        again = SHARDS.order(job, settings)
    assert (order.spans, again.spans) == (((0, 4),), ((0, 1), (2, 4)))
    with unit_of_work(maker) as session:  # what the first worker sends late is not stored
        JobService(session, SHARDS).keep(first, order.attempt, [part])
    assert get(client, f"{sweep}/results")["values"]["point"] == [2]


def test_a_process_that_is_cancelled_sends_the_points_that_it_has_finished() -> None:
    design = read_design(definition())
    own = tuple(column.as_dict() for column in columns(design))
    order = ShardOrder("shard", 1, "sweep", definition(), own, ((0, 4),), Settings(data=Path("none")))
    line = Line(most=4)  # it asks before each point and once in it
    assert process.execute(order, line).cancelled  # type: ignore[arg-type]
    assert [(part.first, part.count) for part in line.parts] == [(0, 2)]


def test_a_sweep_is_deleted_with_its_results_once_it_has_ended(client: TestClient, settings: Settings) -> None:
    sweep = submit(client)
    assert client.delete(f"{SWEEPS}/{sweep}").status_code == 409
    execute(client, settings)
    assert client.delete(f"{SWEEPS}/{sweep}").status_code == 204
    assert client.get(f"{SWEEPS}/{sweep}").status_code == 404


def test_a_form_gets_the_numbers_of_a_plan(client: TestClient) -> None:
    fields = client.post(f"{SWEEPS}/fields", json=plan()).json()["fields"]
    (found,) = (one for one in fields if one["path"] == DAMPING)
    assert (found["label"], found["shown"], found["factor"], found["value"]) == (
        "Structure: Damping ratio of modes 1 and 2",
        "%",
        0.01,
        0.02,
    )


def test_what_is_left_of_spans() -> None:
    assert left([(0, 10)], [(2, 4), (4, 5), (9, 10)]) == [(0, 2), (5, 9)]
    assert left([(0, 3), (5, 8)], [(0, 3)]) == [(5, 8)]
    assert left([(0, 3)], [(0, 3)]) == []


def test_a_sweep_has_a_report_with_the_chosen_result(done: tuple[TestClient, str]) -> None:
    client, sweep = done
    text = client.get(f"{SWEEPS}/{sweep}/report.html").text
    assert "Delay and damping" in text and "Influence of the inputs" in text and "<svg" in text
    assert client.get(f"{SWEEPS}/{sweep}/report.pdf").content.startswith(b"%PDF-")
    refused = client.get(f"{SWEEPS}/{sweep}/report.html", params={"measure": "colour"})
    assert refused.status_code == 422 and refused.json()["errors"][0]["where"] == "measure"


def test_a_sweep_with_a_blank_name_is_refused(client: TestClient) -> None:
    refused = client.post(SWEEPS, json={"sweep": definition(name="  ")})
    assert (refused.status_code, refused.json()["errors"][0]["problem"]) == (422, "is blank")
