"""The values by which lists sort and filter follow from plans and measures, and a list never reads a plan."""

from __future__ import annotations

import threading
from typing import Any

import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.config import Settings
from app.db import unit_of_work
from app.models import RunValue, ValuePath
from app.runs import values
from rths_engine.planning import templates
from tests.app.conftest import app_of
from tests.app.test_runs_api import RUNS, execute, submit

OF_REQUESTS = "AnyIO worker thread"


def stored(client: TestClient) -> dict[str, Any]:
    with unit_of_work(app_of(client).state.sessions) as session:
        query = sa.select(ValuePath.path, RunValue.number, RunValue.text).join(RunValue, RunValue.path_id == ValuePath.id)
        return {path: text if number is None else number for path, number, text in session.execute(query)}


def test_a_new_run_has_the_values_of_its_plan_and_an_ended_run_those_of_its_measures(
    client: TestClient, settings: Settings
) -> None:
    run_id = submit(client)
    planned = stored(client)
    plan = client.get(f"{RUNS}/{run_id}").json()["plan"]
    assert planned["plan.stations.0.compensator.kind"] == plan["stations"][0]["compensator"]["kind"]
    assert planned["plan.structure.storeys.1.mass"] == plan["structure"]["storeys"][1]["mass"]
    assert not any(key.startswith(("mte_mm", "floors_peak_mm")) for key in planned)
    summary = execute(client, settings, run_id)
    measured = stored(client)
    first, second = (station["mee_kNm"] for station in summary["stations"])
    assert (measured["mee_kNm:1"], measured["mee_kNm:2"]) == (first, second)
    assert measured["mee_kNm:max"] == max(first, second, key=abs)
    assert measured["floors_peak_mm:max"] == max(summary["floors_peak_mm"])


def test_samples_and_texts_for_people_are_no_values() -> None:
    plan = templates.template("two-storeys").as_dict()
    plan["motion"] = {"kind": "inline", "dt": 0.01, "acceleration": [0.0] * 9}
    plan["start"] = {"displacement": [1, 2]}
    found = dict(values.plan_values(plan))
    assert found["plan.motion.dt"] == 0.01 and found["plan.start.displacement.1"] == 2
    assert not any("acceleration" in path or path.endswith((".name", ".notes")) for path in found)


def test_a_list_reads_no_plan_and_asks_the_database_as_often_for_many_runs_as_for_a_few(client: TestClient) -> None:
    def statements() -> list[str]:
        found: list[str] = []

        def note(*given: object) -> None:
            if threading.current_thread().name == OF_REQUESTS:  # others look after leases and webhooks now and then
                found.append(str(given[2]))

        engine = app_of(client).state.sessions.kw["bind"]
        sa.event.listen(engine, "before_cursor_execute", note)
        assert client.get(RUNS, params={"limit": 500}).status_code == 200
        sa.event.remove(engine, "before_cursor_execute", note)
        return found

    submit(client)
    few = statements()
    for seed in range(4):
        submit(client, seed=seed)
    assert len(statements()) == len(few)
    assert not any("run_plan" in statement for statement in few)
