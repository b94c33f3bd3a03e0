"""Readiness with a reason for each check, and metrics that Prometheus reads."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient
from prometheus_client.parser import text_string_to_metric_families

from app import db, disk, metrics
from app.jobs.tables import WorkerHeartbeat
from app.monitoring import checks, collected, endpoints, reporting
from tests.app.conftest import app_of, plan


def checked(client: TestClient) -> tuple[int, dict[str, Any]]:
    answer = client.get("/readyz")
    return answer.status_code, {one["name"]: one for one in answer.json()["checks"]}


def samples(text: str) -> dict[tuple[str, frozenset[tuple[str, str]]], float]:
    found = {}
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            key = sample.name, frozenset(sample.labels.items())
            assert key not in found, f"{key} stands twice"
            found[key] = sample.value
    return found


def sample(client: TestClient, name: str, **labels: str) -> float | None:
    return samples(client.get("/metrics").text).get((name, frozenset(labels.items())))


@pytest.fixture
def client(serving: TestClient, monkeypatch: pytest.MonkeyPatch) -> TestClient:
    monkeypatch.setattr(collected, "KEPT_S", 0.0)
    return serving


@pytest.fixture
def beating(client: TestClient) -> Iterator[TestClient]:
    """The service with a worker that is alive."""
    maker = app_of(client).state.sessions
    with db.unit_of_work(maker) as session:
        session.add(WorkerHeartbeat(worker="one", seen_at=datetime.now(UTC), tests_at_a_time=3))
    yield client
    with db.unit_of_work(maker) as session:
        session.execute(sa.delete(WorkerHeartbeat))


def test_a_service_with_a_worker_is_ready(beating: TestClient) -> None:
    status, found = checked(beating)
    assert status == 200 and list(found) == ["database", "schema", "worker", "clock", "store", "disk"]
    assert all(one["ok"] and one["reason"].endswith(".") for one in found.values())


def test_without_a_worker_the_service_is_not_ready(client: TestClient) -> None:
    assert client.get("/livez").status_code == 200  # load balancers: Abort stays reachable
    status, found = checked(client)
    assert status == 503 and not found["worker"]["ok"] and "rths worker" in found["worker"]["reason"]


def test_a_database_of_another_schema_is_not_ready(beating: TestClient) -> None:
    maker, set_to = app_of(beating).state.sessions, sa.text("UPDATE alembic_version SET version_num = :schema")
    with db.unit_of_work(maker) as session:
        known = session.scalar(sa.text("SELECT version_num FROM alembic_version"))
        session.execute(set_to, {"schema": "0001"})
    status, found = checked(beating)
    with db.unit_of_work(maker) as session:
        session.execute(set_to, {"schema": known})
    assert status == 503 and "schema 0001" in found["schema"]["reason"] and "rths migrate" in found["schema"]["reason"]


def test_a_clock_behind_what_is_stored_is_not_ready(beating: TestClient) -> None:
    with db.unit_of_work(app_of(beating).state.sessions) as session:
        session.merge(WorkerHeartbeat(worker="one", seen_at=datetime.now(UTC) + timedelta(hours=1)))
    status, found = checked(beating)
    assert status == 503 and "3600 s behind" in found["clock"]["reason"]


def test_a_disk_below_its_reserve_is_not_ready(beating: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(disk, "reserve", lambda *_: 10**18)
    status, found = checked(beating)
    assert status == 503 and "are refused" in found["disk"]["reason"]


def test_a_database_that_is_gone_is_not_ready(beating: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    missing = db.connect("sqlite:////no/such/folder.sqlite")
    monkeypatch.setitem(app_of(beating).state._state, "sessions", db.sessions(missing))
    status, found = checked(beating)
    missing.dispose()
    assert status == 503 and not found["database"]["ok"] and "worker" not in found


def test_checks_that_hang_are_answered_in_time(beating: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    released = threading.Event()
    monkeypatch.setattr(endpoints, "WITHIN_S", 0.05)
    monkeypatch.setattr(checks, "readiness", lambda *_: released.wait(30))
    status, found = checked(beating)
    released.set()
    assert status == 503 and "did not end within 0.05 s" in found["checks"]["reason"]


def test_requests_are_counted_by_the_template_of_their_route(client: TestClient) -> None:
    labels = {"method": "GET", "route": "/api/v1/runs/{run_id}", "status": "404"}
    before = sample(client, "rths_requests_total", **labels) or 0
    for number in range(3):
        client.get(f"/api/v1/runs/{number}")
    client.head("/api/v1/runs/4")
    assert sample(client, "rths_requests_total", **labels) == before + 3
    assert sample(client, "rths_requests_total", **{**labels, "method": "HEAD"})


def test_an_address_without_a_route_makes_no_label_of_its_own(client: TestClient) -> None:
    for number in range(3):
        client.get(f"/static/none-{number}.js")
        client.get(f"/none-{number}")
        client.request("BREW", f"/none-{number}")
    text = client.get("/metrics").text
    assert "none-" not in text and "BREW" not in text


def test_jobs_workers_and_disk_are_reported(beating: TestClient) -> None:
    beating.post("/api/v1/runs", json={"plan": plan()})
    assert sample(beating, "rths_jobs", kind="run", state="queued") == 1
    assert (sample(beating, "rths_queue_oldest_seconds", kind="run") or -1) >= 0
    assert sample(beating, "rths_workers_alive") == 1 and sample(beating, "rths_workers_tests_at_a_time") == 3
    assert (sample(beating, "rths_disk_free_bytes") or 0) > 0 and sample(beating, "rths_database_up") == 1


def test_an_abort_is_timed(client: TestClient) -> None:
    before = sample(client, "rths_abort_seconds_count") or 0
    client.post("/api/v1/abort", json={"by": "Ana Ruiz"})
    assert sample(client, "rths_abort_seconds_count") == before + 1


def test_metrics_of_workers_come_through_the_database(client: TestClient) -> None:
    maker = app_of(client).state.sessions
    metrics.RUN_SECONDS.labels("run", "completed").observe(2.0)
    reporting.report(maker, "one")
    reporting.report(maker, "two")
    own = metrics.REGISTRY.get_sample_value("rths_job_seconds_count", {"kind": "run", "state": "completed"})
    for worker in ("one", "two"):
        labels = {"kind": "run", "state": "completed", "worker": worker}
        assert sample(client, "rths_worker_job_seconds_count", **labels) == own


def test_without_a_database_the_metrics_of_the_process_remain(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    missing = db.connect("sqlite:////no/such/folder.sqlite")
    monitor: endpoints.Monitor = app_of(client).state.monitor
    monkeypatch.setattr(monitor.collected, "maker", db.sessions(missing))
    assert sample(client, "rths_database_up") == 0 and sample(client, "rths_requests_in_progress") == 1
    missing.dispose()


def test_open_websockets_are_counted_by_side(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    token = {"authorization": f"Bearer {app_of(client).state.settings.worker_token}"}
    with (
        client.websocket_connect("/api/v1/worker", headers=token),
        client.websocket_connect(f"/api/v1/runs/{run}/live") as viewer,
    ):
        viewer.receive_json()
        assert sample(client, "rths_websockets", side="worker") == sample(client, "rths_websockets", side="viewer") == 1
    client.post(f"/api/v1/runs/{run}/cancel", json={})
