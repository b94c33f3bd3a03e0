"""Annotations of a run: written, numbered in order of time, edited, deleted, and shown in its report."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.annotations import service
from app.config import Settings
from tests.app.conftest import plan
from tests.app.test_runs_api import execute, submit

NOTE = {"from_s": 1.5, "to_s": None, "station": 2, "text": "Saturates", "by": "Ana Ruiz"}


@pytest.fixture
def run(client: TestClient, settings: Settings) -> str:
    """A run of 2 s with its recording."""
    run = submit(client)
    execute(client, settings, run)
    return run


def notes(client: TestClient, run: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.get(f"/api/v1/runs/{run}/annotations").json()["annotations"]
    return found


def test_annotations_are_numbered_in_order_of_time_edited_and_deleted(client: TestClient, run: str) -> None:
    address = f"/api/v1/runs/{run}/annotations"
    late = client.post(address, json=NOTE).json()
    early = client.post(address, json={**NOTE, "from_s": 0.5, "to_s": 1.0, "station": None, "text": " Oil is loud "})
    assert early.status_code == 201 and early.json()["number"] == 1 and early.json()["text"] == "Oil is loud"
    assert [(one["number"], one["text"]) for one in notes(client, run)] == [(1, "Oil is loud"), (2, "Saturates")]
    moved = client.put(f"{address}/{late['id']}", json={**NOTE, "from_s": 0.1, "text": "It saturates"}).json()
    assert (moved["number"], moved["text"]) == (1, "It saturates") and moved["edited_at"]
    assert client.delete(f"{address}/{late['id']}").status_code == 204
    assert [one["text"] for one in notes(client, run)] == ["Oil is loud"]
    for answer in (
        client.delete(f"{address}/{late['id']}"),
        client.put(f"{address}/none", json=NOTE),
        client.get("/api/v1/runs/no/annotations"),
    ):
        assert answer.status_code == 404


@pytest.mark.parametrize(
    ("change", "where", "problem"),
    [
        ({"from_s": 99.0}, "from_s", "after the end of the test at 2.00 s"),
        ({"to_s": 1.0}, "to_s", "needs a time after from_s = 1.5 s"),
        ({"station": 3}, "station", "needs a station from 1 to 2"),
        ({"text": "  "}, "text", "is empty"),
        ({"from_s": -1.0}, "from_s", "greater than or equal to 0"),
        ({"text": "\x00"}, "text", "can't be stored"),
    ],
)
def test_an_annotation_outside_the_test_is_refused_with_the_bound(
    client: TestClient, run: str, change: dict[str, Any], where: str, problem: str
) -> None:
    answer = client.post(f"/api/v1/runs/{run}/annotations", json={**NOTE, **change})
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["where"] == where and problem in error["problem"]
    assert notes(client, run) == []


def test_a_time_after_a_trip_and_a_run_without_a_recording_are_refused(client: TestClient, settings: Settings) -> None:
    data = plan()
    data["stations"][0]["limits"]["velocity"] = 0.001
    tripped = submit(client, stations=data["stations"])
    address = f"/api/v1/runs/{tripped}/annotations"
    early = client.post(address, json=NOTE)
    assert early.status_code == 409 and "is queued and has no recording to annotate" in early.json()["detail"]
    end = execute(client, settings, tripped)["simulated_s"]
    (error,) = client.post(address, json=NOTE).json()["errors"]
    assert end < 1.0 and error["problem"] == f"is after the end of the test at {end:.2f} s"
    assert client.post(address, json={**NOTE, "from_s": round(end, 3)}).status_code == 201
    cancelled = submit(client)
    client.post(f"/api/v1/runs/{cancelled}/cancel", json={"by": "Ana"})
    assert client.post(f"/api/v1/runs/{cancelled}/annotations", json={**NOTE, "from_s": 0.0}).status_code == 409


def test_a_run_has_at_most_as_many_annotations_as_a_report_can_show(
    client: TestClient, run: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(service, "MOST", 3)
    for _ in range(3):
        assert client.post(f"/api/v1/runs/{run}/annotations", json=NOTE).status_code == 201
    answer = client.post(f"/api/v1/runs/{run}/annotations", json=NOTE)
    assert answer.status_code == 409 and "Delete one first" in answer.json()["detail"]


def test_the_report_of_a_run_shows_annotations_notes_rig_and_laboratory(client: TestClient, settings: Settings) -> None:
    run = submit(client, **{key: value for key, value in plan().items() if key == "duration"})
    execute(client, settings, run)
    client.post(f"/api/v1/runs/{run}/annotations", json=NOTE)
    client.put("/api/v1/laboratory", json={"name": "Structures Laboratory", "address": "", "signatures": ["Director"]})
    text = client.get(f"/api/v1/runs/{run}/report.html").text
    assert len(text.encode()) < 1e6
    for said in ("Structures Laboratory", "Saturates", "Ana Ruiz", "Director", "<svg", "Emulated"):
        assert said in text, said
    paper = client.get(f"/api/v1/runs/{run}/report.pdf")
    assert paper.headers["content-type"] == "application/pdf" and paper.content.startswith(b"%PDF-")
    assert "plotly" in client.get(f"/api/v1/runs/{run}/report.html", params={"interactive": True}).text
