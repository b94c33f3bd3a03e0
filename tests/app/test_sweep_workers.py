"""Sweeps in whole workers: on SQLite with one worker, and on PostgreSQL with two, of which one is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.config import Settings
from app.db import unit_of_work
from app.main import create_app
from app.models import SweepShard
from tests.app.conftest import ADDRESS, HERE, app_of, plan
from tests.browser.service import ROOT, UNMEASURED, until

SWEEPS = "/api/v1/sweeps"
WORKER = "import sys; from tests.app.test_sweep_workers import work; work(*sys.argv[1:])"
PATIENCE_S = 90
MANY = 1200  # points: work for both workers while they start


def definition(points: int, duration: float) -> dict[str, Any]:
    distribution = {"kind": "uniform", "lower": 20, "upper": 40}
    fields = [{"path": "stations.*.compensator.alpha_es", "distribution": distribution}]
    return {"plan": plan(duration=duration), "method": "latin_hypercube", "samples": points, "fields": fields}


def work(data: str, database: str, name: str) -> None:
    """A worker that executes only sweeps, in one process."""
    from app.sweeps.job import SHARDS
    from app.worker.main import work as serve

    settings = Settings(data=Path(data), database_url=database, sweep_processes=1).prepared()
    serve(settings, "ws://127.0.0.1:1", name, [SHARDS])


@contextmanager
def worker(settings: Settings, name: str) -> Iterator[subprocess.Popen[bytes]]:
    command = [sys.executable, "-c", WORKER, str(settings.data), settings.database_url, name]
    process = subprocess.Popen(command, cwd=ROOT, env=UNMEASURED)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def submit(client: TestClient, points: int, duration: float) -> str:
    answer = client.post(SWEEPS, json={"sweep": definition(points, duration)})
    assert answer.status_code == 201, answer.text
    found: str = answer.json()["id"]
    return found


def get(client: TestClient, sweep: str) -> Any:
    return client.get(f"{SWEEPS}/{sweep}").json()


def wait(client: TestClient, sweep: str, good: Callable[[Any], bool]) -> Any:
    return until(lambda: get(client, sweep), good, PATIENCE_S)


def points(client: TestClient, sweep: str) -> dict[int, float]:
    """Computing time of each point: another execution has another."""
    values = client.get(f"{SWEEPS}/{sweep}/results").json()["values"]
    assert len(set(values["point"])) == len(values["point"])
    return dict(zip(values["point"], values["elapsed_s"], strict=True))


def test_a_sweep_is_cancelled_within_a_second_and_resumes_with_the_points_left(client: TestClient, settings: Settings) -> None:
    with worker(settings, "only"):
        sweep = submit(client, 40, 20.0)
        wait(client, sweep, lambda one: one["done"] > 0)
        assert client.post(f"{SWEEPS}/{sweep}/cancel", json={"by": "Bo"}).status_code == 200
        done = get(client, sweep)["done"]
        cancelled = wait(client, sweep, lambda one: one["state"] == "cancelled")
        assert 0 < cancelled["done"] < 40
        kept = points(client, sweep)
        assert (cancelled["done"] - done - 1) * min(kept.values()) < 1.0  # s of computing after the cancel
        assert client.post(f"{SWEEPS}/{sweep}/resume", json={"by": "Bo"}).status_code == 200
        found = wait(client, sweep, lambda one: one["state"] == "completed")
    assert found["completed"] == 40
    assert points(client, sweep).items() >= kept.items() and len(kept) == cancelled["done"]


def test_a_killed_worker_of_several_loses_no_point_and_none_is_stored_twice(database: str, tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, database_url=database, embedded_worker=False, local_sign_in=True)
    with (
        TestClient(create_app(settings), ADDRESS, client=HERE) as client,
        worker(settings, "doomed") as doomed,
        worker(settings, "second"),
    ):
        sweep = submit(client, MANY, 20.0)
        workers = sa.select(SweepShard.worker).distinct()
        maker = app_of(client).state.sessions
        until(lambda: _all(maker, workers), lambda found: {"doomed", "second"} <= set(found), PATIENCE_S)
        before = points(client, sweep)
        os.kill(doomed.pid, signal.SIGKILL)
        found = wait(client, sweep, lambda one: one["state"] not in ("queued", "running"))
        assert (found["state"], found["completed"]) == ("completed", MANY)
        after = points(client, sweep)
        assert sorted(after) == list(range(1, MANY + 1)) and after.items() >= before.items()


def _all(maker: Any, query: Any) -> list[Any]:
    with unit_of_work(maker) as session:
        return list(session.scalars(query))
