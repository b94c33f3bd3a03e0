"""The live websocket as a viewer sees it, with a scripted worker at the other end."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.testclient import WebSocketTestSession
from starlette.websockets import WebSocketDisconnect

from app.config import Settings
from app.db import unit_of_work
from app.jobs.service import JobService
from app.live import frames, watching
from app.live.frames import Decimator, bucket_size
from app.live.messages import schema
from app.live.uplink import FRAME_HEADER
from app.models import Run
from app.runs.job import RUNS
from app.runs.order import Outcome
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.run_file import save
from rths_engine.running.run import simulate
from tests.app.conftest import app_of, plan


class Told:
    """A run that a worker has under way, told part by part."""

    def __init__(self, client: TestClient, settings: Settings, worker: WebSocketTestSession):
        self.client, self.settings, self.worker = client, settings, worker
        self.result = simulate(read_plan(plan()))
        self.total = len(self.result.signals)
        self.id: str = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": "Ana"}).json()["runs"][0]["id"]
        self.attempt = 0

    def start(self) -> None:
        """Take the run up, as the first worker or as one that follows a dead one."""
        self.attempt += 1
        with self._service() as runs:
            runs.start(self.id, "scripted")
        bucket = bucket_size(self.total)
        self.decimator = Decimator(self.result.channels, bucket, self.result.dt)
        self.say(schema(self.attempt, self.result.dt, bucket, self.total, self.decimator.channels))

    def say(self, message: dict[str, Any]) -> None:
        self.worker.send_json({"run_id": self.id, "attempt": self.attempt, "message": message})

    def show(self, until: int) -> bytes:
        """Tell of the rows up to `until`; the buckets' bytes."""
        frame = self.decimator.frame(self.result.signals, until, ended=until == self.total)
        assert frame is not None
        self.worker.send_bytes(FRAME_HEADER.pack(self.id.encode(), self.attempt) + frame)
        return frame[8:]

    def store(self) -> Path:
        path = self.settings.recordings / f"{self.id}.h5"
        saved = save(path, self.result)
        with self._service() as runs:
            runs.finish(self.id, self.attempt, Outcome(self.result.summary(), saved.sha256, saved.size))
        return path

    def park(self) -> None:
        with self._service() as runs:
            runs.fail(self.id, self.attempt, "Its worker died.")

    @property
    def whole(self) -> bytes:
        decimator = Decimator(self.result.channels, bucket_size(self.total), self.result.dt)
        frame = decimator.frame(self.result.signals, self.total, ended=True)
        assert frame is not None
        return frame[8:]

    @contextmanager
    def viewer(self, first: int = 0) -> Iterator[WebSocketTestSession]:
        with self.client.websocket_connect(f"/api/v1/runs/{self.id}/live?from={first}") as socket:
            yield socket

    @contextmanager
    def _service(self) -> Iterator[JobService[Run, Outcome]]:
        with unit_of_work(app_of(self.client).state.sessions) as session:
            yield JobService(session, RUNS)


@pytest.fixture
def told(client: TestClient, settings: Settings) -> Iterator[Told]:
    token = {"Authorization": f"Bearer {settings.worker_token}"}
    with client.websocket_connect("/api/v1/worker", headers=token) as worker:
        yield Told(client, settings, worker)


def take(socket: WebSocketTestSession, enough: int | None = None) -> tuple[list[dict[str, Any]], bytes]:
    """Messages other than progress, and the buckets' bytes since the last schema; until `enough` bytes or the end."""
    messages: list[dict[str, Any]] = []
    buckets = b""
    while enough is None or len(buckets) < enough:
        got = socket.receive()
        if got["type"] == "websocket.close":
            raise WebSocketDisconnect(got["code"], got["reason"])
        if got.get("bytes") is not None:
            buckets += got["bytes"][8:]
            continue
        message = json.loads(got["text"])
        if message["type"] == "schema":
            buckets = b""
        if message["type"] != "progress":
            messages.append(message)
        if message["type"] == "end":
            break
    return messages, buckets


def test_a_viewer_sees_frames_as_they_come_and_the_end(told: Told) -> None:
    told.start()
    with told.viewer() as socket:
        first = told.show(500)
        messages, early = take(socket, len(first))
        assert early == first and [message["type"] for message in messages] == ["schema"]
        second = told.show(told.total)
        assert take(socket, len(second))[1] == second
        told.store()
        told.say({"type": "end"})
        messages, rest = take(socket)
    assert rest == b"" and messages[-1]["run"]["state"] == "completed"


def test_what_a_viewer_missed_because_the_worker_was_cut_off_comes_from_the_recording(told: Told) -> None:
    told.start()
    with told.viewer() as socket:
        first = told.show(700)
        _, early = take(socket, len(first))
        told.store()
        told.say({"type": "end"})
        messages, rest = take(socket)
    assert early + rest == told.whole
    assert [message["type"] for message in messages] == ["end"]  # no second schema, which would drop the early part


def test_what_is_longer_than_one_frame_comes_in_several_live_and_from_the_recording(
    told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(frames, "PIECE", len(told.whole) // 7)
    told.start()
    first = told.show(1500)
    with told.viewer() as socket:
        _, early = take(socket, len(first))
        told.store()
        told.say({"type": "end"})
        assert early == first and early + take(socket)[1] == told.whole


def test_a_new_attempt_begins_the_viewers_data_anew(told: Told) -> None:
    told.start()
    with told.viewer() as socket:
        take(socket, len(told.show(700)))
        told.start()
        again = told.show(300)
        messages, early = take(socket, len(again))
        assert [message["attempt"] for message in messages] == [2] and early == again
        told.store()
        told.say({"type": "end"})
        assert early + take(socket)[1] == told.whole


def test_a_viewer_who_saw_only_an_attempt_that_died_gets_the_one_that_was_stored(told: Told) -> None:
    told.start()
    with told.viewer() as socket:
        take(socket, len(told.show(700)))
        told.attempt += 1
        with told._service() as runs:
            runs.start(told.id, "unconnected")
        told.store()
        told.say({"type": "end"})
        messages, whole = take(socket)
    assert [message["type"] for message in messages] == ["schema", "end"] and messages[0]["attempt"] == 2
    assert whole == told.whole


def test_a_viewer_of_a_run_that_was_parked_is_told_of_its_end(told: Told) -> None:
    told.start()
    with told.viewer() as socket:
        take(socket, len(told.show(300)))
        told.park()
        told.say({"type": "end"})
        messages, _ = take(socket)
    assert messages[-1]["run"]["state"] == "failed" and messages[-1]["run"]["reason"] == "Its worker died."


def test_a_run_whose_worker_fell_silent_ends_for_its_viewers_and_takes_no_memory(
    told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(watching, "SILENT_S", 0.02)
    told.start()
    with told.viewer() as socket:
        take(socket, len(told.show(300)))
        told.park()
        messages, _ = take(socket)
    assert messages[-1]["run"]["state"] == "failed"
    assert app_of(told.client).state.hub.runs == {}


@pytest.mark.parametrize("harm", [lambda path: path.unlink(), lambda path: path.write_bytes(b"no HDF5")])
def test_a_recording_that_cannot_be_read_is_told_as_such(told: Told, harm: Any) -> None:
    told.start()
    harm(told.store())
    told.say({"type": "end"})
    with told.viewer() as socket, pytest.raises(WebSocketDisconnect) as refused:
        take(socket)
    assert (refused.value.code, refused.value.reason) == (4409, "the recording is missing or damaged")
