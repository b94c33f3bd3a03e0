"""Files are compared with their checksums before they are served or read: a damaged file is a 409 that says what to do."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.config import Settings
from app.db import unit_of_work
from app.diagnoses.order import DiagnosisOrder
from app.live.watching import UNREADABLE
from app.measured.service import filed as filed_measured
from app.models import MeasuredRecording, Run, Sweep, SweepPart
from app.runs.exports import filed as filed_run
from app.sweeps.service import SweepService
from app.worker import diagnosis as process
from app.worker.child import Refused
from tests.app.conftest import app_of
from tests.app.test_earlier_files import rows

API = "/api/v1"
DAMAGE = {
    "cut": (lambda content: content[:-100], "bytes; its row states"),
    "altered": (lambda content: content[:-100] + bytes(255 - one for one in content[-100:]), "its row states"),
    "deleted": (lambda content: None, "the store has no file"),
}


@contextmanager
def damaged(path: Path, damage: Callable[[bytes], bytes | None]) -> Iterator[None]:
    """A file that is damaged for a while."""
    content = path.read_bytes()
    worse = damage(content)
    path.unlink() if worse is None else path.write_bytes(worse)
    try:
        yield
    finally:
        path.write_bytes(content)


def settings_of(client: TestClient) -> Settings:
    found: Settings = app_of(client).state.settings
    return found


@pytest.mark.parametrize("how", DAMAGE)
def test_a_damaged_recording_of_a_run_is_not_served_reported_compared_or_replayed(earlier: TestClient, how: str) -> None:
    damage, problem = DAMAGE[how]
    run, other = (rows(earlier, "runs")[name] for name in ("Completed", "Tripped"))
    parts = ("recording.h5", "recording.csv", "recording.mat", "report.html", "report.pdf")
    addresses = [f"{API}/runs/{run['id']}/{part}" for part in parts]
    addresses += [f"{API}/compare?items=run:{other['id']},run:{run['id']}"]
    key = f"recordings/{run['id']}.h5"
    with damaged(settings_of(earlier).data / key, damage):
        for address in addresses:
            answer = earlier.get(address)
            assert answer.status_code == 409 and answer.headers["content-type"] == "application/problem+json", address
            said = answer.json()["detail"]
            assert said.startswith(f"The recording of run {run['number']} (Completed) is "), said
            assert key in said and problem in said and "restore the file from a backup" in said, said
        with earlier.websocket_connect(f"{API}/runs/{run['id']}/live") as socket, pytest.raises(WebSocketDisconnect) as closed:
            while True:
                socket.receive_json()
        assert closed.value.code == UNREADABLE
    for address in addresses:
        assert earlier.get(address).status_code == 200, address  # restored


def test_a_damaged_import_and_its_raw_file_are_not_served(earlier: TestClient) -> None:
    recording = rows(earlier, "recordings")["Sine test"]
    measured, damage = settings_of(earlier).measured, DAMAGE["altered"][0]
    one = f"{API}/recordings/{recording['id']}"
    with damaged(measured / f"{recording['id']}.h5", damage):
        for address in (f"{one}/recording.h5", f"{one}/preview"):
            answer = earlier.get(address)
            assert answer.status_code == 409 and recording["sha256"] in answer.json()["detail"], address
    with damaged(measured / "raw" / recording["raw_sha256"], damage):
        for address in (f"{one}/raw", f"{API}/recordings/files/{recording['raw_sha256']}"):
            answer = earlier.get(address)
            assert answer.status_code == 409 and "The uploaded file" in answer.json()["detail"], address


@pytest.mark.parametrize("which", ["run", "recording"])
def test_a_damaged_recording_is_not_diagnosed(earlier: TestClient, which: str) -> None:
    with unit_of_work(app_of(earlier).state.sessions) as session:
        row: Any = (
            session.query(Run if which == "run" else MeasuredRecording)
            .filter_by(id=rows(earlier, f"{which}s")["Completed" if which == "run" else "Sine test"]["id"])
            .one()
        )
        filed = filed_run(row) if which == "run" else filed_measured(row)
    settings = settings_of(earlier)
    order = DiagnosisOrder("diagnosis", 1, None, "Test", filed, (), 0.01, settings)
    with damaged(settings.data / filed.key, DAMAGE["cut"][0]), pytest.raises(Refused, match=r"is damaged.*restore the file"):
        process.execute(order, Line())  # type: ignore[arg-type]


class Line:
    """The line of a process to its worker."""

    def progress(self, doing: str, share: float) -> None: ...


def test_altered_results_of_a_sweep_are_not_served_and_results_without_checksum_are_said_so(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SweepService, "_trial", lambda *_: 0.5)
    definition = {"plan": short_plan(client), "fields": [{"path": "seed", "values": [1, 2]}]}
    answer = client.post(f"{API}/sweeps", json={"sweep": definition})
    assert answer.status_code == 201, answer.text
    sweep = f"{API}/sweeps/{answer.json()['id']}"
    with unit_of_work(app_of(client).state.sessions) as session:
        stored = session.query(Sweep).one()
        row = bytes(8 * len(stored.columns))
        facts = {"reasons": {}, "tripped": 0, "invalid": 0, "failed": 0, "elapsed_s": 1.0, "simulated_s": 1.0}
        part = SweepPart(sweep_number=stored.number, first=0, count=1, values=row, stored_at=stored.submitted_at, **facts)
        session.add(part)
    assert client.get(f"{sweep}/results").status_code == 200
    assert any("No checksum is stored for the results of 1 points" in note for note in client.get(sweep).json()["notes"])
    with unit_of_work(app_of(client).state.sessions) as session:
        session.query(SweepPart).update({"sha256": "0" * 64})
    for address in (f"{sweep}/results", f"{sweep}/results?form=csv", f"{sweep}/report.html"):
        answer = client.get(address)
        assert answer.status_code == 409 and "restore the database from a backup" in answer.json()["detail"], address
    assert not any("checksum" in note for note in client.get(sweep).json()["notes"])


def short_plan(client: TestClient) -> dict[str, Any]:
    plan: dict[str, Any] = client.get(f"{API}/templates/two-storeys").json()["plan"]
    return {**plan, "duration": 1.0}
