"""Readiness with a reason for each check, and metrics that Prometheus reads."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient
from prometheus_client.parser import text_string_to_metric_families
from ruamel.yaml import YAML

from app import db, disk, metrics
from app.events.tables import Event, EventKind
from app.jobs.tables import WorkerHeartbeat
from app.monitoring import checks, collected, endpoints, reporting
from tests.app.conftest import app_of, plan
from tests.browser.service import until

OPERATION = Path(__file__).parents[2] / "docs" / "operation"


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
    monkeypatch.setattr(endpoints, "KEPT_S", 0.0)
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


@pytest.mark.parametrize("alive", [True, False])
def test_a_clock_that_was_set_back_is_not_ready_until_a_worker_lives_by_it(beating: TestClient, alive: bool) -> None:
    later = datetime.now(UTC) + timedelta(hours=1)
    with db.unit_of_work(app_of(beating).state.sessions) as session:
        session.add(WorkerHeartbeat(worker="before", seen_at=later))
        session.add(event := Event(at=later, kind=EventKind.RELEASED, sentence="Released.", about="queue"))
        if not alive:
            session.execute(sa.delete(WorkerHeartbeat).where(WorkerHeartbeat.worker == "one"))
    status, found = checked(beating)
    with db.unit_of_work(app_of(beating).state.sessions) as session:
        session.delete(event)
    assert (status, found["clock"]["ok"]) == ((200, True) if alive else (503, False))
    assert "3600 s later" in found["clock"]["reason"] or "3599 s later" in found["clock"]["reason"]


def test_a_clock_apart_from_that_of_the_database_is_not_ready(beating: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(db, "now", lambda _: datetime.now(UTC) + timedelta(hours=1))
    status, found = checked(beating)
    assert status == 503 and "3600 s apart" in found["clock"]["reason"]


def test_who_is_not_signed_in_reads_only_the_names_of_failed_checks(beating: TestClient) -> None:
    stranger = TestClient(app_of(beating), "http://127.0.0.1:8000", client=("192.0.2.1", 1))
    assert stranger.get("/readyz").json() == {"ready": True, "checks": []}
    with db.unit_of_work(app_of(beating).state.sessions) as session:
        session.execute(sa.delete(WorkerHeartbeat))
    answer = stranger.get("/readyz", headers={"authorization": "Bearer made-up"})
    (failed,) = answer.json()["checks"]
    assert answer.status_code == 503 and (failed["name"], failed["ok"]) == ("worker", False)
    assert failed["reason"].startswith("Sign in")


def test_probes_share_one_look_at_the_checks(beating: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    looks: list[int] = []
    real, done = checks.readiness, threading.Event()

    def counted(*given: Any) -> Any:
        looks.append(1)
        done.wait(30)
        return real(*given)

    monkeypatch.setattr(checks, "readiness", counted)
    monkeypatch.setattr(endpoints, "WITHIN_S", 60.0)
    with ThreadPoolExecutor(3) as threads:
        probes = [threads.submit(beating.get, "/readyz") for _ in range(3)]
        until(
            lambda: sample(beating, "rths_requests_in_progress"), lambda number: number == 4
        )  # three probes, and this request
        done.set()
        assert [one.result().status_code for one in probes] == [200, 200, 200]
    monkeypatch.setattr(endpoints, "KEPT_S", 600.0)
    assert beating.get("/readyz").status_code == 200 and looks == [1]


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


def named_metrics(text: str) -> set[str]:
    """Names of metrics in expressions of Prometheus."""
    found = re.findall(r"\b(?:rths|process)_[a-z_]+\b", text)
    return {re.sub(r"_(bucket|sum|count|total)$", "", one) for one in found}


@pytest.fixture
def known(beating: TestClient) -> set[str]:
    """Names of the metrics that a service and a worker report."""
    reporting.report(app_of(beating).state.sessions, "one")
    families = text_string_to_metric_families(beating.get("/metrics").text)
    return {family.name.removesuffix("_total") for family in families}


def test_every_metric_of_the_dashboard_and_of_the_alerts_is_reported(known: set[str]) -> None:
    dashboard = json.loads((OPERATION / "rths-grafana.json").read_text(encoding="utf-8"))
    panels = dashboard["panels"]
    assert len({one["id"] for one in panels}) == len(panels) > 20 and dashboard["uid"] and dashboard["schemaVersion"]
    sources = {f"${{{one['name']}}}" for one in dashboard["templating"]["list"] if one["type"] == "datasource"}
    expressions = []
    for panel in panels:
        place, targets = panel["gridPos"], panel.get("targets", [])
        assert place["x"] + place["w"] <= 24 and (targets or panel["type"] == "row"), panel["title"]
        assert len({one["refId"] for one in targets}) == len(targets), panel["title"]
        assert all(one["datasource"]["uid"] in sources for one in targets), panel["title"]
        expressions += [one["expr"] for one in targets]
    alerts = YAML(typ="safe").load((OPERATION / "rths-alerts.yaml").read_text(encoding="utf-8"))
    expressions += [rule["expr"] for group in alerts["groups"] for rule in group["rules"]]
    for expression in expressions:
        names = named_metrics(expression)
        assert names <= known and (names or expression.startswith("up{")), expression


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
