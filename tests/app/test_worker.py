"""The queue and the worker in a whole service: cancel, kill, crash, hold; and the live stream as viewers get it."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import sqlite3
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosedError, InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from rths_engine.recordings.run_file import load
from tests.browser.service import DATABASE_URL, Service, running, until

SLOW = {"kind": "real_time", "factor": 1.0}
QUICK = {"kind": "real_time", "factor": 8.0}


@pytest.fixture
def data(service: Service) -> Path:
    return service.data


def descendants(pid: int) -> list[int]:
    found = [int(child) for thread in Path(f"/proc/{pid}/task").glob("*/children") for child in thread.read_text().split()]
    return [*found, *(deeper for child in found for deeper in descendants(child))]


def named(pid: int, text: str) -> bool:
    try:
        return text in Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode()
    except OSError:
        return False


def processes(service: Service, text: str) -> list[int]:
    return [pid for pid in descendants(service.pid) if named(pid, text)]


def stored_once(service: Service, data: Path, run: dict[str, Any]) -> None:
    path = data / "recordings" / f"{run['id']}.h5"
    assert hashlib.sha256(path.read_bytes()).hexdigest() == run["recording"]["sha256"]
    assert [other.name for other in path.parent.iterdir() if run["id"] in other.name] == [path.name]
    assert sum(other["id"] == run["id"] for other in service.get("/runs?limit=500")["runs"]) == 1


def live(service: Service, run_id: str, first: int = 0) -> ClientConnection:
    return connect(f"{service.url.replace('http', 'ws')}/api/v1/runs/{run_id}/live?from={first}", max_size=None)


def watch(socket: ClientConnection, enough: int | None = None) -> tuple[dict[str, Any], bytes, list[dict[str, Any]]]:
    """Schema, the buckets' bytes in order, and the other messages; until the end, or `enough` buckets."""
    schema: dict[str, Any] = {}
    buckets, messages, seen = b"", [], 0
    for message in socket:
        if isinstance(message, bytes):
            seen += int.from_bytes(message[4:8], "little")
            buckets += message[8:]
            if enough is not None and seen >= enough:
                break
        else:
            told = json.loads(message)
            if told["type"] == "schema":
                schema = told
            messages.append(told)
            if told["type"] == "end":
                break
    return schema, buckets, messages


def test_a_queued_test_runs_and_is_stored_with_its_recording(service: Service, data: Path) -> None:
    run = service.wait(service.submit(duration=3.0))
    assert (run["state"], run["attempt"]) == ("completed", 1)
    stored_once(service, data, run)
    assert len(load(data / "recordings" / f"{run['id']}.h5").signals) == 3080  # 308 integration steps cover 3 s


def test_cancel_stops_a_running_test_within_a_second_and_keeps_what_was_recorded(service: Service, data: Path) -> None:
    run_id = service.submit(pace=SLOW, duration=30.0)
    service.wait(run_id, "running")
    with live(service, run_id) as socket:
        watch(socket, enough=300)
        start = time.monotonic()
        service.post(f"/runs/{run_id}/cancel", {"by": "Bo"})
        run = service.wait(run_id)
        took = time.monotonic() - start
    assert run["state"] == "cancelled" and "Bo" in run["reason"]
    assert took < 1.0  # the promise itself, not a benchmark
    stored_once(service, data, run)
    kept = load(data / "recordings" / f"{run_id}.h5")
    assert 0 < kept.dt * len(kept.signals) == pytest.approx(run["simulated_s"])
    assert run["simulated_s"] < 30


def test_a_cancel_touches_no_test_but_its_own(service: Service) -> None:
    for _ in range(3):
        running_id = service.submit(pace=SLOW, duration=30.0)
        next_ones = [service.submit(duration=1.0, seed=seed) for seed in range(3)]
        service.wait(running_id, "running")
        for _ in range(3):
            service.http.post(f"/api/v1/runs/{running_id}/cancel", json={})
        assert service.wait(running_id)["state"] == "cancelled"
        assert {service.wait(run_id)["state"] for run_id in next_ones} == {"completed"}


def test_a_killed_worker_leaves_one_run_executed_again(service: Service, data: Path) -> None:
    run_id = service.submit(pace=QUICK, duration=30.0)
    service.wait(run_id, "running")
    with live(service, run_id) as socket:
        watch(socket, enough=100)
    for pid in processes(service, "app.worker"):
        os.kill(pid, signal.SIGKILL)
    run = service.wait(run_id)
    assert (run["state"], run["attempt"]) == ("completed", 2)
    stored_once(service, data, run)


def test_a_killed_engine_leaves_one_run_executed_again(service: Service, data: Path) -> None:
    run_id = service.submit(pace=QUICK, duration=30.0)
    service.wait(run_id, "running")
    with live(service, run_id) as socket:
        watch(socket, enough=30)
    for pid in processes(service, "spawn_main"):
        os.kill(pid, signal.SIGKILL)
    run = service.wait(run_id)
    assert (run["state"], run["attempt"]) == ("completed", 2)
    stored_once(service, data, run)


def test_abort_holds_what_waits_and_release_lets_it_run(service: Service) -> None:
    first = service.submit(pace=SLOW, duration=30.0)
    service.wait(first, "running")
    service.post("/abort", {"by": "Bo"})
    assert service.wait(first)["state"] == "cancelled"
    waiting = service.submit(duration=2.0)
    time.sleep(0.5)
    assert service.get(f"/runs/{waiting}")["state"] == "queued"
    service.post("/queue/release", {})
    assert service.wait(waiting)["state"] == "completed"


@pytest.mark.skipif(bool(DATABASE_URL), reason="the lock is that of SQLite")
def test_abort_stops_a_test_while_another_connection_holds_the_lock_of_the_database(service: Service) -> None:
    run = service.submit(pace=SLOW, duration=30.0)
    service.wait(run, "running")
    with closing(sqlite3.connect(service.data / "rths.sqlite", isolation_level=None, timeout=60)) as other:
        other.execute("begin immediate")
        answer = service.post("/abort", {"by": "Bo"})
        assert (answer["held"], answer["recorded"]) == (True, False)
        until(lambda: service.get("/abort"), lambda found: found["acknowledged"] and not found["running"])
        other.rollback()
    ended = service.wait(run)
    assert ended["state"] == "cancelled" and ended["reason"].startswith("Stopped by Bo at ")
    assert ended["recording"]["sha256"]
    until(lambda: service.get("/abort")["recorded"], bool)
    service.post("/queue/release", {})
    assert not service.get("/abort")["held"]


def test_the_order_of_the_queue_holds_while_two_run_and_their_worker_is_killed(service: Service) -> None:
    latest = service.get("/events?limit=1")["latest"]
    service.post("/queue/hold", {"by": "Bo"})
    runs = {name: service.submit(name=name, pace=QUICK, duration=8.0) for name in "ABCDE"}
    service.post("/queue/order", {"runs": [runs["E"], runs["D"]], "to": "top"})
    service.post("/queue/priority", {"runs": [runs["C"]], "priority": 1})
    service.post("/queue/release", {})
    service.wait(runs["E"], "running")
    for pid in processes(service, "app.worker"):
        os.kill(pid, signal.SIGKILL)
    assert {service.wait(run)["state"] for run in runs.values()} == {"completed"}
    events = service.get(f"/events?after={latest}&kind=started")["events"]
    started = [event["name"] for event in reversed(events)]
    assert list(dict.fromkeys(started)) == ["C", "E", "D", "A", "B"]
    assert 5 < len(started) <= 7  # the one or two that ran when the worker was killed started once more


def test_a_viewer_who_comes_back_gets_exactly_what_one_who_stayed_got(service: Service) -> None:
    run_id = service.submit(pace=QUICK, duration=20.0)
    with live(service, run_id) as staying:
        with live(service, run_id) as leaving:
            schema, early, _ = watch(leaving, enough=200)
        row = len(schema["channels"]) * 3 * 4
        with live(service, run_id, first=len(early) // row) as back:
            _, late, _ = watch(back)
        _, whole, messages = watch(staying)
    assert early + late == whole
    assert len(whole) == schema["buckets"] * row
    assert messages[-1]["run"]["state"] == "completed"
    so_far = [one["timing"]["steps"] for one in messages if one.get("timing")]
    stored = service.get(f"/runs/{run_id}")["timing"]
    assert so_far and so_far == sorted(so_far) and stored["steps"] == so_far[-1] == 20 * 1024
    assert [one["rate_hz"] for one in stored["verdicts"]] == [1024, 2048, 4096]
    assert [message["type"] for message in messages[:1]] in (["schema"], ["progress"])
    with live(service, run_id) as after:  # from the recording
        replayed, again, _ = watch(after)
    assert again == whole
    assert replayed["channels"] == schema["channels"]


def test_a_slow_viewer_gets_few_large_frames_and_never_holds_the_run(service: Service) -> None:
    run_id = service.submit(pace=QUICK, duration=20.0)
    service.wait(run_id, "running")
    with live(service, run_id) as idle:
        run = service.wait(run_id)  # nobody reads meanwhile
        _, whole, _ = watch(idle)
    assert run["state"] == "completed"
    assert run["elapsed_s"] == pytest.approx(20 / 8, abs=1.0)
    with live(service, run_id) as after:
        assert watch(after)[1] == whole


def test_live_values_are_those_of_the_recording(service: Service, data: Path) -> None:
    run_id = service.submit(duration=2.0)
    service.wait(run_id)
    with live(service, run_id) as socket:
        schema, whole, _ = watch(socket)
    values = np.frombuffer(whole, "<f4").reshape(-1, len(schema["channels"]), 3)
    recorded = load(data / "recordings" / f"{run_id}.h5")
    column = [channel["key"] for channel in schema["channels"]].index("x_meas.1")
    bucket = schema["bucket"]
    assert values[:, column, 2] == pytest.approx(recorded.signal("x_meas.1")[bucket - 1 :: bucket] * 1e3, rel=1e-6, abs=1e-9)


def test_an_unknown_run_is_refused_with_a_reason(service: Service) -> None:
    with live(service, "none") as socket, pytest.raises(ConnectionClosedError, match=r"4404.*no such run"):
        watch(socket)


def test_frames_are_taken_only_with_the_workers_token(service: Service) -> None:
    address = f"{service.url.replace('http', 'ws')}/api/v1/worker"
    with (
        connect(address, additional_headers={"Authorization": "Bearer guess"}) as socket,
        pytest.raises(ConnectionClosedError, match="4403"),
    ):
        socket.recv()


def test_another_sites_page_cannot_watch(service: Service) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        connect(f"{service.url.replace('http', 'ws')}/api/v1/runs/none/live", origin=Origin("http://elsewhere.example"))


def test_a_restarted_web_service_takes_its_runs_up_again(tmp_path: Path) -> None:
    with running(tmp_path) as before:
        run_id = before.submit(pace=SLOW, duration=6.0)
        before.wait(run_id, "running")
    with running(tmp_path) as after:
        run = after.wait(run_id)
        assert run["state"] == "completed"
        stored_once(after, after.data, run)
        assert httpx.get(f"{after.url}/healthz").json()["worker"] == "alive"
