"""What happened is stored with what happened, in sentences that stand alone, and read back by time and by number."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session

from app import db
from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs.service import JobService
from app.models import Run
from app.runs.job import RUNS
from app.runs.order import Outcome
from tests.app.conftest import app_of, plan


@pytest.fixture
def run(client: TestClient) -> str:
    return str(client.post("/api/v1/runs", json={"plan": plan(name="Brace")}).json()["runs"][0]["id"])


def jobs(session: Session) -> JobService[Run, Outcome]:
    return JobService(session, RUNS)


def told(client: TestClient, **query: Any) -> list[tuple[str, str]]:
    found = client.get("/api/v1/events", params=query).raise_for_status().json()["events"]
    return [(one["kind"], one["sentence"]) for one in found]


def test_starts_ends_and_holds_are_told_newest_first(client: TestClient, run: str) -> None:
    maker = app_of(client).state.sessions
    with db.unit_of_work(maker) as session:
        jobs(session).start(run, "one")
    with db.unit_of_work(maker) as session:
        jobs(session).fail(run, 1, "The engine stopped.")
    client.post("/api/v1/abort", json={"by": "Ana"})
    client.post("/api/v1/queue/release", json={"by": "Bo"})
    client.post("/api/v1/queue/release", json={"by": "Bo"})  # not held any more: nothing to tell
    assert told(client) == [
        ("released", "Bo released the queue."),
        ("held", "Ana held the queue: running tests aborted"),
        ("failed", "Run 1, Brace: The engine stopped."),
        ("started", "Run 1, Brace: Started on worker one."),
    ]
    assert told(client, run_id=run, kind="failed") == [("failed", "Run 1, Brace: The engine stopped.")]
    answer = client.get("/api/v1/events", params={"limit": 1}).json()
    assert (answer["total"], answer["latest"], answer["events"][0]["run_id"]) == (4, 4, None)
    assert [kind for kind, _ in told(client, after=3)] == ["released"]
    assert told(client, since=datetime.now(UTC).isoformat()) == []
    assert len(told(client, since=(datetime.now(UTC) - timedelta(minutes=1)).isoformat())) == 4


def test_what_was_rolled_back_is_not_told(client: TestClient, run: str) -> None:
    maker = app_of(client).state.sessions
    with pytest.raises(ZeroDivisionError), db.unit_of_work(maker) as session:
        jobs(session).cancel(run, "Bo")
        raise ZeroDivisionError
    with db.unit_of_work(maker) as session:
        assert EventLog(session).latest() == 0
    client.post(f"/api/v1/runs/{run}/cancel", json={"by": "Bo"})
    assert told(client) == [(EventKind.CANCELLED, "Run 1, Brace: Cancelled by Bo before it started.")]


@pytest.mark.parametrize("query", ["after=-1", "kind=began", "since=yesterday", "limit=501", "colour=red"])
def test_a_wrong_question_is_refused_with_the_parameter(serving: TestClient, query: str) -> None:
    answer = serving.get(f"/api/v1/events?{query}")
    assert answer.status_code == 422 and answer.json()["errors"][0]["where"].startswith(query.partition("=")[0])
