"""The run table by REST: columns, filters, order, and what people say about runs."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any, NamedTuple

import pytest
from fastapi.testclient import TestClient

from app.config import Settings
from app.db import unit_of_work
from app.jobs.states import State
from app.main import create_app
from app.models import Diagnosis, DiagnosisInput, Run, RunStation
from app.runs import query
from app.runs.editing import GRACE, RunEditing
from app.store.opening import store_of
from tests.app.conftest import ADDRESS, HERE, app_of, plan
from tests.app.test_runs_api import RUNS

TABLE = f"{RUNS}/table"
ALPHA = "plan.stations.0.compensator.alpha_es"


class Laboratory(NamedTuple):
    client: TestClient
    ids: list[str]


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory, migrated: Any) -> Iterator[Laboratory]:
    """Runs #1 to #6: five have ended with measures 1 mm to 5 mm at station 1, the last is queued."""
    settings = Settings(data=tmp_path_factory.mktemp("table"), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        plans = []
        for number in range(1, 7):
            one = plan(name=f"Brace {number}", seed=number)
            one["stations"][0]["compensator"] = {"kind": "inverse", "alpha_es": 10.0 * number}
            plans.append(one)
        ids = [run["id"] for run in client.post(RUNS, json={"plans": plans, "submitted_by": "Ana"}).json()["runs"]]
        with unit_of_work(app_of(client).state.sessions) as session:
            for run in session.query(Run).filter(Run.number < 6):
                run.state = State.TRIPPED if run.number == 5 else State.COMPLETED
                run.elapsed_s, run.finished_at = 1.5, datetime.now(UTC)
                run.stations = [RunStation(number=n, name="Damper", mte_mm=float(run.number) / n) for n in (1, 2)]
        yield Laboratory(client, ids)


@pytest.fixture(params=["few", "many"])
def size(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both ways to a page give the same runs: with few runs as they are, and as if each filter kept many."""
    if request.param == "many":
        monkeypatch.setattr(query, "FEW", 0)
        monkeypatch.setattr(query, "BUDGET", 2)


def numbers(client: TestClient, where: str = "", **other: Any) -> list[int]:
    answer = client.get(TABLE, params={"where": where, "order": "asc", **other})
    assert answer.status_code == 200, answer.text
    return [row["number"] for row in answer.json()["rows"]]


@pytest.mark.parametrize(
    ("where", "kept"),
    [
        ("", [1, 2, 3, 4, 5, 6]),
        ("state=tripped|queued", [5, 6]),
        ("state!=completed", [5, 6]),
        ("name~BRACE 2", [2]),
        ("number>4", [5, 6]),
        ("mte_mm:1<=2", [1, 2]),
        ("mte_mm:2=0.5", [1]),
        ("mte_mm:max>=0.004 m", [4, 5]),
        ("mte_mm:1=", [6]),
        ("mte_mm:1!=", [1, 2, 3, 4, 5]),
        ("mte_mm:1!=3", [1, 2, 4, 5, 6]),
        ("finished_at=", [6]),
        ("finished_at>-1 h", [1, 2, 3, 4, 5]),
        ("submitted_at<2020-01-01", []),
        (f"{ALPHA}>=30", [3, 4, 5, 6]),
        (f"{ALPHA}>=30;mte_mm:1<5", [3, 4]),
        ("plan.stations.0.compensator.kind=inverse;number<2", [1]),
        ("plan.stations.0.compensator.kind!=inverse", []),
        ("plan.stations.1.actuator.kind~first", [1, 2, 3, 4, 5, 6]),
        ("tag=", [1, 2, 3, 4, 5, 6]),
        ("archived=yes", []),
    ],
)
def test_a_filter_keeps_the_runs_that_meet_it(lab: Laboratory, size: None, where: str, kept: list[int]) -> None:
    assert numbers(lab.client, where) == kept
    assert numbers(lab.client, where, sort=ALPHA, order="desc") == kept[::-1]
    measured = numbers(lab.client, where, sort="mte_mm:1", order="desc")
    assert measured == sorted(kept, key=lambda number: (number != 6, number), reverse=True)  # without a measure: last
    assert numbers(lab.client, where, sort="mte_mm:1", limit=2, offset=1) == numbers(lab.client, where, sort="mte_mm:1")[1:3]


@pytest.mark.parametrize(
    ("parameter", "value", "told"),
    [
        ("where", "mte_mn:1<3", "try mte_mm"),
        ("where", "mte_mm:99<3", "station number"),
        ("where", "mte_mm:1<fast", "needs a number"),
        ("where", "mte_mm:1<nan", "finite"),
        ("where", "mte_mm:1~3", "not a text"),
        ("where", "state=compleated", "completed"),
        ("where", "state", "not a valid condition"),
        ("where", "number>", "needs a value"),
        ("where", "submitted_at>yesterday", "not a valid date"),
        ("where", "archived=perhaps", "yes nor no"),
        ("where", "tags<a", "no order"),
        ("where", "seed=1;" * 21, "limit"),
        ("sort", "plan.stations.0.compensator.alpha", "alpha_es"),
        ("columns", "name,plan.nothing", "not a column"),
        ("columns", ",".join(f"mte_mm:{n % 32 + 1}" for n in range(41)), "limit"),
        ("shelf", "under the bed", "shelf"),
    ],
)
def test_a_bad_request_says_what_and_how_to_mend_it(lab: Laboratory, parameter: str, value: str, told: str) -> None:
    answer = lab.client.get(TABLE, params={parameter: value})
    assert answer.status_code == 422, answer.text
    assert told in answer.text
    assert lab.client.get(f"{TABLE}.csv", params={parameter: value}).status_code == 422


def test_cells_are_in_the_unit_of_their_column(lab: Laboratory) -> None:
    columns = f"number,mte_mm:1,plan.stations.0.limits.velocity,plan.stations.0.compensator.kind,{ALPHA},finished_at,tags"
    table = lab.client.get(TABLE, params={"columns": columns, "order": "asc"}).json()
    assert [one["key"] for one in table["columns"]] == columns.split(",")
    assert [one["unit"] for one in table["columns"]][1:3] == ["mm", "mm/s"]
    kind = table["columns"][3]
    assert "inverse" in [one["value"] for one in kind["choices"]]
    first, last = table["rows"][0]["cells"], table["rows"][-1]["cells"]
    limit = plan()["stations"][0]["limits"]["velocity"]
    assert first[:5] == [1, 1.0, pytest.approx(1e3 * limit), "inverse", 10.0]
    assert datetime.fromisoformat(first[5]).tzinfo is not None and last[5] is None and first[6] == []
    assert (table["total"], table["exact"]) == (6, True)


def test_the_csv_has_the_columns_and_all_runs_that_the_filter_keeps(lab: Laboratory) -> None:
    query = {"columns": "number,name,mte_mm:1", "where": "mte_mm:1>2", "sort": "mte_mm:1"}
    answer = lab.client.get(f"{TABLE}.csv", params=query)
    assert answer.headers["content-type"].startswith("text/csv")
    rows = list(csv.reader(io.StringIO(answer.text)))
    assert rows == [
        ["Run", "Name", "MTE, station 1, mm"],
        ["5", "Brace 5", "5.0"],
        ["4", "Brace 4", "4.0"],
        ["3", "Brace 3", "3.0"],
    ]


def test_columns_are_listed_with_label_unit_and_choices(lab: Laboratory) -> None:
    found = lab.client.get(f"{RUNS}/columns").json()
    columns = {one["key"]: one for one in found["columns"]}
    assert columns[ALPHA]["group"] == "Plan" and "Station 1" in columns[ALPHA]["label"]
    assert columns["mte_mm:max"]["heading"] == "MTE, largest, mm"
    assert {"number", "mte_mm:max", "submitted_at"} <= set(found["default"])


def test_a_search_finds_number_name_and_tag(lab: Laboratory) -> None:
    assert numbers(lab.client, q="#3") == [3]
    assert numbers(lab.client, q="brace 4") == [4]
    assert numbers(lab.client, q="#nothing") == [] == numbers(lab.client, q="%")


def test_a_new_name_tags_and_notes_leave_plan_and_digest(lab: Laboratory) -> None:
    client, path = lab.client, f"{RUNS}/{lab.ids[0]}"
    before = client.get(path).json()
    change = {"name": "  Reference ", "tags": ["calibration", "paper 3", "calibration"], "notes": "New oil."}
    after = client.patch(path, json=change).json()
    assert (after["name"], after["tags"], after["notes"]) == ("Reference", ["calibration", "paper 3"], "New oil.")
    assert after["digest"] == before["digest"] and client.get(path).json()["plan"] == before["plan"]
    assert (
        numbers(client, "tag=paper 3") == [1]
        and numbers(client, "tag=paper") == []
        and numbers(client, "tag!=paper 3", limit=1) == [2]
    )
    assert client.get(f"{RUNS}/tags").json()["tags"] == ["calibration", "paper 3"]
    for wrong in ({"tags": ["a;b"]}, {"tags": [""]}, {"name": " "}, {"colour": "red"}, {"tags": ["x"] * 21}):
        assert client.patch(path, json=wrong).status_code == 422
    client.patch(path, json={"name": before["name"], "tags": [], "notes": ""})


def test_archived_and_deleted_runs_are_hidden_until_they_are_wanted(lab: Laboratory) -> None:
    client, (first, second, *_, queued) = lab.client, lab.ids
    assert client.patch(f"{RUNS}/{first}", json={"archived": True}).json()["archived"] is True
    assert client.delete(f"{RUNS}/{second}").status_code == 204
    assert numbers(client) == [3, 4, 5, 6] and client.get(RUNS).json()["total"] == 4
    assert [numbers(client, shelf=shelf) for shelf in ("archived", "deleted", "all")] == [[1], [2], [1, 3, 4, 5, 6]]
    for answer in (client.delete(f"{RUNS}/{queued}"), client.patch(f"{RUNS}/{queued}", json={"archived": True})):
        assert answer.status_code == 409 and "has not ended" in answer.json()["detail"]
    assert client.post(f"{RUNS}/{second}/restore").json()["deleted_at"] is None
    client.patch(f"{RUNS}/{first}", json={"archived": False})
    assert numbers(client) == [1, 2, 3, 4, 5, 6]


def test_one_action_on_several_runs_reports_those_that_it_cannot_change(lab: Laboratory) -> None:
    def bulk(action: str, **other: Any) -> Any:
        return lab.client.post(f"{RUNS}/bulk", json={"action": action, "runs": [*lab.ids, "none"], **other}).json()

    assert len(bulk("tag", tags=["batch"])["changed"]) == 6 and numbers(lab.client, "tag=batch", limit=1) == [1]
    assert len(bulk("untag", tags=["batch"])["changed"]) == 6 and numbers(lab.client, "tag=batch") == []
    deleted = bulk("delete")
    assert deleted["changed"] == lab.ids[:5]
    assert [one["id"] for one in deleted["refused"]] == [lab.ids[5], "none"]
    assert len(bulk("restore")["changed"]) == 6 and numbers(lab.client) == [1, 2, 3, 4, 5, 6]
    assert lab.client.post(f"{RUNS}/bulk", json={"action": "tag", "runs": lab.ids}).status_code == 422


def test_a_deleted_run_and_its_recording_are_removed_after_the_grace_period(lab: Laboratory) -> None:
    app, doomed = app_of(lab.client), lab.ids[4]
    folder = app.state.settings.recordings
    (folder / f"{doomed}.h5").write_bytes(b"recording")
    lab.client.delete(f"{RUNS}/{doomed}")
    for wait, removed in ((GRACE - timedelta(hours=1), 0), (GRACE + timedelta(hours=1), 1)):
        with unit_of_work(app.state.sessions) as session:
            assert RunEditing(session).purge(store_of(app.state.settings), datetime.now(UTC) + wait) == removed
        assert (folder / f"{doomed}.h5").exists() is not bool(removed)
    assert lab.client.get(f"{RUNS}/{doomed}").status_code == 404
    assert numbers(lab.client, f"{ALPHA}>40") == [6]


def test_a_run_that_a_diagnosis_uses_stays(lab: Laboratory) -> None:
    used = lab.ids[3]
    facts = {"plan": {}, "level": 0.01, "code_version": "0", "state": "completed", "submitted_by": "Ana", "id": "d"}
    with unit_of_work(app_of(lab.client).state.sessions) as session:
        inputs = [DiagnosisInput(place=0, name="Brace 4", run_id=used)]
        session.add(Diagnosis(name="Worn damper", submitted_at=datetime.now(UTC), inputs=inputs, **facts))
    answer = lab.client.delete(f"{RUNS}/{used}")
    assert answer.status_code == 409 and "diagnosis 1, Worn damper" in answer.json()["detail"]


def test_a_view_is_a_name_for_an_address(lab: Laboratory) -> None:
    views = f"{RUNS}/views"
    saved = lab.client.post(views, json={"name": "Mine", "query": "?where=tag%3Dpaper", "by": "Ana"}).json()
    again = lab.client.post(views, json={"name": "Mine", "query": "sort=mte_mm%3A1", "by": "Bo"}).json()
    assert again["id"] == saved["id"] and (again["query"], again["saved_by"]) == ("sort=mte_mm%3A1", "Bo")
    assert [one["name"] for one in lab.client.get(views).json()["views"]] == ["Mine"]
    assert lab.client.delete(f"{views}/{saved['id']}").status_code == 204
    assert lab.client.delete(f"{views}/{saved['id']}").status_code == 404 == lab.client.delete(f"{views}/none").status_code
