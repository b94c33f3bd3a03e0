"""Table IV over REST and on its page."""

from __future__ import annotations

from fastapi.testclient import TestClient
from sqlalchemy.orm import Session

from app import db
from app.config import Settings
from app.jobs.service import JobService
from app.runs.job import RUNS
from app.runs.order import Outcome
from rths_engine import table4
from rths_engine.table4.comparison import MEASURES, PAPER, published, stable


def test_one_post_queues_the_twelve_with_the_papers_compensation(client: TestClient) -> None:
    answer = client.post("/api/v1/table4", json={"by": "Ana Ruiz"})
    assert answer.status_code == 201
    runs = answer.json()["runs"]
    assert [run["template"] for run in runs] == [table4.name(number) for number in PAPER]
    assert {run["submitted_by"] for run in runs} == {"Ana Ruiz"}
    table = client.get("/api/v1/table4").json()
    assert [one["run"]["id"] for one in table["simulations"]] == [run["id"] for run in runs]
    assert not any(one["changed"] for one in table["simulations"])
    assert table["ended"] == 0 and table["median_factor"] is None


def test_an_empty_table_still_shows_the_paper(client: TestClient) -> None:
    table = client.get("/api/v1/table4").json()
    assert [one["simulation"] for one in table["simulations"]] == list(range(1, 13))
    assert [one["simulation"] for one in table["simulations"] if one["paper"] is None] == [1, 7, 10]
    assert table["simulations"][1]["paper"]["mte_mm"] == [2.0, 3.2]
    page = client.get("/table4").text
    assert "None of the twelve simulations has run yet" in page and "2.0 / 3.2" in page


def test_ended_runs_are_compared_with_the_paper(client: TestClient, settings: Settings) -> None:
    runs = client.post("/api/v1/table4").json()["runs"]
    for number, run in enumerate(runs, start=1):
        end(settings, run["id"], summary(number))
    table = client.get("/api/v1/table4").json()
    assert (table["ended"], table["outcomes_right"], table["signs_right"], table["signs"]) == (12, 12, 36, 36)
    assert table["median_factor"] == table["worst_factor"] == 2.0
    page = client.get("/table4").text
    assert f'href="/runs/{runs[1]["id"]}"' in page
    assert "12 of 12 simulations have ended; 12 of them have the paper's outcome" in page
    assert page.count("<title>Simulation") == 54


def test_a_run_of_a_changed_plan_is_told_apart(client: TestClient) -> None:
    plan = table4.plans(table4.BUNDLED)[4].as_dict() | {"seed": 99}
    client.post("/api/v1/runs", json={"plan": plan})
    table = client.get("/api/v1/table4").json()
    assert [one["simulation"] for one in table["simulations"] if one["changed"]] == [4]
    assert "different plan" in client.get("/table4/now").text


def summary(number: int) -> dict[str, object]:
    """A run's summary with twice the paper's measures."""
    paper = PAPER[number]
    fields = {"name": "Storey", "peak_stroke_mm": 1.0, "peak_force_kN": 1.0}
    stations = [
        {**fields, **{field: 2 * published(paper, field, j) if stable(paper) else 0.0 for field in MEASURES}} for j in range(2)
    ]
    trip = None if stable(paper) else {"time_s": 1.25, "sentence": "Tripped."}
    status = "completed" if stable(paper) else "tripped"
    times = {"elapsed_s": 0.1, "simulated_s": 40.0}
    peaks = {"floors_peak_mm": [50.0, 95.0], "input_energy_kNm": 900.0}
    return {"status": status, "trip": trip, "stations": stations, **peaks, **times}


def end(settings: Settings, run_id: str, found: dict[str, object]) -> None:
    """End a run as a worker does."""
    with Session(db.connect(settings.url)) as session:
        service = JobService(session, RUNS)
        started = service.start(run_id, "worker").started
        assert started is not None and started.id == run_id
        service.finish(run_id, 1, Outcome(found, "0" * 64, 1))
        session.commit()
