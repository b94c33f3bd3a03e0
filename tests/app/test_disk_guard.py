"""The disk guard: new tests and uploads are refused before the disk is full, and a full disk is never an internal error."""

from __future__ import annotations

import errno
import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.routing import iter_route_contexts
from fastapi.testclient import TestClient

from app import disk, full
from app.config import MEGABYTE, Settings
from app.disk_guard import SMALL_ROWS, creates
from app.main import create_app
from app.worker.child import Refused
from app.worker.room import HEADER, largest, room_for
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import read_model
from rths_engine.recordings.run_file import save
from rths_engine.running.run import Run
from tests.app.conftest import ADDRESS, HERE, app_of, plan

GB = 1000 * MEGABYTE
MOTION = b"0.0\n0.1\n-0.1\n0.0\n" * 20


@pytest.fixture
def low(serving: TestClient, monkeypatch: pytest.MonkeyPatch) -> TestClient:
    """A service whose disk is below its reserve."""
    monkeypatch.setattr(disk, "space", lambda _: disk.Space(free=GB, reserve=2 * GB))
    return serving


@pytest.mark.parametrize(
    ("total", "kept"), [(16 * MEGABYTE, 4 * MEGABYTE), (20 * GB, 2 * GB), (200 * GB, 10 * GB), (4000 * GB, 20 * GB)]
)
def test_the_reserve_follows_the_size_of_the_disk(total: int, kept: int) -> None:
    assert disk.reserve(Settings(), total) == kept


def test_the_reserve_can_be_set() -> None:
    assert disk.reserve(Settings(disk_reserve=5 * MEGABYTE), 4000 * GB) == 5 * MEGABYTE


def test_a_test_is_refused_while_the_disk_is_low(low: TestClient) -> None:
    answer = low.post("/api/v1/runs", json={"plan": plan()})
    assert answer.status_code == 507 and answer.json()["title"] == "Insufficient storage"
    assert "has 1.0 GB free; the service keeps 2.0 GB free" in answer.json()["detail"] and "Delete" in answer.json()["detail"]
    assert low.get("/api/v1/runs").json()["runs"] == []


def test_an_upload_is_refused_before_it_is_read(low: TestClient) -> None:
    def never() -> Iterator[bytes]:
        yield b"x"
        raise AssertionError("the body was read")

    answer = low.post("/api/v1/motions", content=never(), headers={"content-length": "7000000"})
    assert answer.status_code == 507


def test_an_upload_that_would_take_the_reserve_is_refused(serving: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(disk, "space", lambda _: disk.Space(free=2 * GB + 5 * MEGABYTE, reserve=2 * GB))
    answer = serving.post("/api/v1/motions", content=b"x", headers={"content-length": "7000000"})
    assert answer.status_code == 507 and "this request has 7.0 MB" in answer.json()["detail"]


def test_what_stops_or_reads_goes_on_while_the_disk_is_low(low: TestClient) -> None:
    for path in ("/api/v1/abort", "/api/v1/queue/hold", "/api/v1/queue/release"):
        assert low.post(path, json={"by": "Ana Ruiz"}).is_success, path
    assert low.get("/api/v1/runs").is_success and low.get("/runs").is_success


def test_small_rows_are_stored_while_the_disk_is_low(low: TestClient) -> None:
    for path, body in (
        ("/api/v1/accounts", {"name": "Ana Ruiz", "role": "engineer"}),
        ("/api/v1/runs/views", {"name": "Mine", "query": "q=brace", "by": "Ana Ruiz"}),
        ("/api/v1/library/plans", {"name": "Brace", "plan": plan()}),
    ):
        assert low.post(path, json=body).status_code == 201, path
    large = low.post("/api/v1/library/plans", content=b"x", headers={"content-length": str(2 * MEGABYTE)})
    assert large.status_code == 507


def test_every_page_says_that_the_disk_is_low(low: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    said = "New tests and uploads are refused"
    assert said in low.get("/queue").text
    monkeypatch.setattr(disk, "space", lambda _: disk.Space(free=3 * GB, reserve=2 * GB))
    assert said not in low.get("/queue").text


def test_the_guard_knows_every_route_that_creates_data(serving: TestClient) -> None:
    found = {str(one.path) for one in iter_route_contexts(app_of(serving).routes) if creates(one)}
    assert {
        "/api/v1/runs",
        "/api/v1/runs/{run_id}/retry",
        "/api/v1/sweeps",
        "/api/v1/sweeps/{sweep_id}/resume",
        "/api/v1/diagnoses",
        "/api/v1/recordings",
        "/api/v1/recordings/files",
        "/api/v1/motions",
        "/api/v1/laboratory/logo",
    } <= found
    assert not [path for path in found if path.endswith(("/abort", "/cancel", "/hold", "/release", "/archive"))]
    assert found >= SMALL_ROWS


class Broken:
    """An endpoint that fails as a full disk makes it fail."""

    def __init__(self, error: Exception):
        self.error = error

    def __call__(self, *_: Any, **__: Any) -> Any:
        raise self.error


FULL = {
    "file": OSError(errno.ENOSPC, "No space left on device"),
    "quota": OSError(errno.EDQUOT, "Disk quota exceeded"),
    "hdf5": OSError("Can't write data (file write failed: error message = 'No space left on device')"),
    "sqlite": sa.exc.OperationalError("INSERT", {}, Exception("database or disk is full")),
    "postgres": sa.exc.OperationalError("INSERT", {}, type("DiskFull", (Exception,), {"sqlstate": "53100"})()),
}


@pytest.mark.parametrize("kind", FULL)
def test_a_full_disk_is_answered_as_such(serving: TestClient, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.motions.service.MotionService.add", Broken(FULL[kind]))
    answer = serving.post("/api/v1/motions", files={"file": ("m.txt", MOTION)}, data={"unit": "g", "dt": "0.02"})
    assert answer.status_code == 507, answer.text
    assert "disk of the service is full" in answer.json()["detail"]


def test_a_full_disk_for_temporary_files_is_answered_as_such(serving: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("starlette.formparsers.MultiPartParser.parse", Broken(FULL["file"]))
    answer = serving.post("/api/v1/motions", files={"file": ("m.txt", MOTION)}, data={"unit": "g", "dt": "0.02"})
    assert answer.status_code == 507, answer.text


def test_another_error_of_a_file_stays_an_internal_error(serving: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.motions.service.MotionService.add", Broken(OSError(errno.EIO, "Input/output error")))
    answer = serving.post("/api/v1/motions", files={"file": ("m.txt", MOTION)}, data={"unit": "g", "dt": "0.02"})
    assert answer.status_code == 500


def test_the_room_for_a_recording_is_held_until_it_is_saved(tmp_path: Path) -> None:
    run = Run(read_model(plan(duration=0.5)), MotionLibrary(None))
    run.advance(10_000)
    path = tmp_path / "one.h5"
    with room_for(run, path) as release:
        (room,) = tmp_path.iterdir()
        assert room.stat().st_blocks * 512 >= largest(run) > HEADER
        release()
        save(path, run.result("completed", 0.0))
    assert list(tmp_path.iterdir()) == [path] and path.stat().st_size <= largest(run)


def test_a_test_without_room_is_not_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "posix_fallocate", Broken(FULL["file"]))
    run = SimpleNamespace(signals=SimpleNamespace(nbytes=8_000_000, __len__=int), history=SimpleNamespace(nbytes=0))
    monkeypatch.setattr("app.worker.room.largest", lambda _: 8_000_000)
    with pytest.raises(Refused, match=r"no room for the recording, 8\.0 MB at most"), room_for(run, tmp_path / "one.h5"):
        raise AssertionError("the test started")
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def tiny(tmp_path: Path) -> Iterator[Path]:
    """A disk of 8 MB."""
    folder = tmp_path / "tiny"
    folder.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", folder], capture_output=True, text=True)
    if mounted.returncode:
        pytest.skip(f"SKIPPED: no small disk can be mounted here (root may): {mounted.stderr.strip()}")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


def test_a_service_on_a_full_disk_refuses_what_is_new_and_shows_what_is_stored(tiny: Path, migrated: Path) -> None:
    folder = tiny / "rths"
    shutil.copytree(migrated.parent, folder)
    settings = Settings(data=folder, embedded_worker=False, local_sign_in=True, disk_reserve=0)
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        stored = client.post("/api/v1/runs", json={"plan": plan()}).json()["runs"][0]["id"]
        with (tiny / "filler").open("wb", buffering=0) as file, pytest.raises(OSError) as raised:
            while True:
                file.write(bytes(4096))
        assert full.is_full(raised.value)
        refused = [client.post("/api/v1/runs", json={"plan": plan(name=f"Test {n}", notes="x" * 20_000)}) for n in range(3)]
        upload = client.post("/api/v1/motions", files={"file": ("m.txt", MOTION)}, data={"unit": "g", "dt": "0.02"})
        assert {one.status_code for one in (*refused, upload)} <= {201, 422, 507} and upload.status_code == 507
        assert client.get(f"/api/v1/runs/{stored}").json()["state"] == "queued"
        assert client.get(f"/runs/{stored}").status_code == 200
        (tiny / "filler").unlink()
        assert client.post("/api/v1/runs", json={"plan": plan()}).status_code == 201
