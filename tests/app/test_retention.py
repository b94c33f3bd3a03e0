"""Retention: which recordings a rule removes, which it never removes, and what stays of their runs."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.audit.log import SERVICE
from app.cli.main import main
from app.config import Settings
from app.db import unit_of_work
from app.jobs.states import State
from app.main import create_app
from app.models import Annotation, AuditEntry, Diagnosis, DiagnosisInput, Rules, Run, RunStation
from app.retention import service
from app.retention.daily import Removal
from app.retention.service import Retention
from app.store.opening import store_of
from tests.app.conftest import ADDRESS, HERE, app_of, plan

RETENTION = "/api/v1/retention"
DAYS_AGO = [400, 300, 200, 100, 90, 80, 70, 60, 0.5]  # ends of the tests of runs #1 to #9; run #10 is queued
SIZE = 1000
EVERY: dict[str, Any] = {"days": None, "gigabytes": None, "states": [], "template": "", "tag": ""}


class Laboratory(NamedTuple):
    client: TestClient
    ids: list[str]

    def preview(self, **rule: Any) -> dict[str, Any]:
        answer = self.client.get(f"{RETENTION}/preview", params=rule)
        assert answer.status_code == 200, answer.text
        found: dict[str, Any] = answer.json()
        return found

    def save(self, **rule: Any) -> dict[str, Any]:
        answer = self.client.put(RETENTION, json=EVERY | rule)
        assert answer.status_code == 200, answer.text
        found: dict[str, Any] = answer.json()
        return found

    def file(self, number: int) -> Path:
        settings: Settings = app_of(self.client).state.settings
        return settings.data / "recordings" / f"{self.ids[number - 1]}.h5"

    def left(self) -> list[int]:
        """The numbers of the runs whose recordings are there."""
        return [number for number in range(1, 11) if self.file(number).exists()]

    def entries(self) -> list[AuditEntry]:
        """What the audit log says about retention."""
        with app_of(self.client).state.sessions() as session:
            query = sa.select(AuditEntry).where(AuditEntry.action.contains("retention")).order_by(AuditEntry.number)
            return list(session.scalars(query))

    def remove(self) -> int:
        """What the daily removal does."""
        app = app_of(self.client)
        return Removal(app.state.sessions, store_of(app.state.settings)).remove().recordings


@pytest.fixture(scope="module")
def submitted(tmp_path_factory: pytest.TempPathFactory, migrated: Path) -> Iterator[Laboratory]:
    """Ten tests in the queue, and an annotation and a diagnosis of two of them."""
    data = shutil.copytree(migrated.parent, tmp_path_factory.mktemp("retention") / "rths")
    settings = Settings(data=data, embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        plans = [plan(name=f"Brace {number}", seed=number) for number in range(1, 11)]
        ids = [run["id"] for run in client.post("/api/v1/runs", json={"plans": plans, "submitted_by": "Ana"}).json()["runs"]]
        with unit_of_work(app_of(client).state.sessions) as session:
            session.add(_note("a", 5))
            session.add(_diagnosis(ids[6]))
            for run in session.query(Run).filter(Run.number < 10):
                run.state = State.TRIPPED if run.number == 8 else State.COMPLETED
                run.finished_at = datetime.now(UTC) - timedelta(days=DAYS_AGO[run.number - 1])
                run.simulated_s, run.tags = 2.0, ["Keep"] if run.number == 6 else []
                run.stations = [RunStation(number=1, name="Damper", mte_mm=1.5)]
        (data / "recordings").mkdir(exist_ok=True)
        yield Laboratory(client, ids)


@pytest.fixture
def lab(submitted: Laboratory) -> Laboratory:
    """Nine tests that have ended, each with 1 kB of recording, and one that is queued; all recordings are kept.

    Run #5 is annotated, run #6 has the tag keep, and a diagnosis uses run #7. Run #8 tripped.
    """
    recorded = {"recording_size": SIZE, "recording_sha256": "0" * 64, "recording_removed_at": None}
    with unit_of_work(app_of(submitted.client).state.sessions) as session:
        session.execute(sa.update(Run).where(Run.number < 10).values(recorded))
        session.execute(sa.update(Rules).values(retention=None, retention_due=None))
    for number in range(1, 10):
        submitted.file(number).write_bytes(b"0" * SIZE)
    return submitted


def _note(own: str, number: int) -> Annotation:
    return Annotation(id=own, run_number=number, from_s=1.0, text="slip", by="Ana", created_at=datetime.now(UTC))


def _diagnosis(run_id: str) -> Diagnosis:
    asked = DiagnosisInput(place=0, name="Brace 7", run_id=run_id)
    own = {"id": "d", "state": State.COMPLETED, "submitted_at": datetime.now(UTC), "submitted_by": "Ana"}
    return Diagnosis(name="Brace", plan={}, level=0.01, code_version="0", inputs=[asked], **own)


def test_at_first_everything_is_kept(lab: Laboratory) -> None:
    held = lab.client.get(RETENTION).json()
    assert (held["days"], held["gigabytes"], held["due_at"]) == (None, None, None)
    assert held["sentence"] == "All recordings are kept."
    assert lab.preview()["recordings"] == lab.remove() == 0
    assert lab.left() == list(range(1, 10))


@pytest.mark.parametrize(
    ("rule", "numbers"),
    [
        ({"days": 1}, [1, 2, 3, 4, 8]),
        ({"days": 250}, [1, 2]),
        ({"gigabytes": 6e-6}, [1, 2, 3]),
        ({"gigabytes": 6.5e-6}, [1, 2, 3]),
        ({"gigabytes": 1e-6}, [1, 2, 3, 4, 8]),
        ({"days": 250, "gigabytes": 6e-6}, [1, 2, 3]),
        ({"days": 150, "gigabytes": 8e-6}, [1, 2, 3]),
        ({"days": 1, "states": ["tripped"]}, [8]),
        ({"days": 1, "states": ["cancelled", "failed"]}, []),
        ({"days": 1, "template": "table3-04"}, []),
        ({"days": 1, "tag": "spring"}, []),
    ],
)
def test_a_rule_removes_old_recordings_and_the_oldest_beyond_a_size(
    lab: Laboratory, rule: dict[str, Any], numbers: list[int]
) -> None:
    found = lab.preview(**rule)
    assert (found["recordings"], found["bytes"], found["total_bytes"]) == (len(numbers), SIZE * len(numbers), 9 * SIZE)
    assert [one["number"] for one in found["oldest"]] == numbers[:5]
    lab.save(**rule)
    assert lab.preview() == found
    assert lab.remove() == len(numbers)
    assert lab.left() == [number for number in range(1, 10) if number not in numbers]
    assert lab.remove() == 0


def test_a_rule_can_be_limited_to_a_template_and_a_tag(lab: Laboratory) -> None:
    with unit_of_work(app_of(lab.client).state.sessions) as session:
        session.execute(sa.update(Run).where(Run.number < 3).values(template="braces"))
        session.execute(sa.update(Run).where(Run.number.in_([2, 3])).values(tags=["spring", "north"]))
    assert [one["number"] for one in lab.preview(days=1, template="braces")["oldest"]] == [1, 2]
    assert [one["number"] for one in lab.preview(days=1, tag="spring")["oldest"]] == [2, 3]
    said = lab.save(days=1, states=["completed", "tripped"], template="braces", tag="spring")["sentence"]
    which = "of tests that are completed or tripped of the template braces with the tag spring"
    assert said == f"A recording {which} is removed 1 day after the end of its test."
    assert lab.remove() == 1
    assert lab.left() == [1, 3, 4, 5, 6, 7, 8, 9]


def test_the_run_stays_with_its_measures_and_says_when_its_recording_was_removed(lab: Laboratory) -> None:
    run, today = f"/api/v1/runs/{lab.ids[0]}", f"{datetime.now(UTC):%Y-%m-%d}"
    lab.save(days=350)
    lab.remove()
    found = lab.client.get(run).json()
    assert found["recording"] is None
    assert found["recording_removed_at"].startswith(today)
    assert found["stations"][0]["mte_mm"] == 1.5
    assert "mte_mm" in lab.client.get(f"{run}/measures.csv").text
    said = f"The recording of run 1 (Brace 1) was removed by retention on {today}. Its plan and its measures are kept."
    for form in ("recording.h5", "recording.csv", "recording.mat", "report.html"):
        answer = lab.client.get(f"{run}/{form}")
        assert (answer.status_code, answer.json()["detail"]) == (409, said), form
    for path, body in (
        ("/api/v1/diagnoses", {"plan_of_run": lab.ids[0], "recording": {"run": lab.ids[0]}}),
        (f"{run}/annotations", {"from_s": 1.0, "text": "slip", "by": "Ana"}),
    ):
        answer = lab.client.post(path, json=body)
        assert (answer.status_code, said in answer.json()["detail"]) == (409, True), answer.text
    answer = lab.client.get("/api/v1/compare", params={"items": [f"run:{lab.ids[0]}", f"run:{lab.ids[1]}"]})
    assert (answer.status_code, said in answer.json()["detail"]) == (409, True), answer.text


def test_a_changed_rule_waits_a_day_and_then_acts_once_a_day(lab: Laboratory) -> None:
    sessions = app_of(lab.client).state.sessions
    removal = Removal(sessions, store_of(app_of(lab.client).state.settings))
    first = lab.save(days=250)["due_at"]
    assert timedelta(hours=23) < datetime.fromisoformat(first) - datetime.now(UTC) <= timedelta(days=1)
    assert not removal.due()
    assert lab.save(days=250)["due_at"] == first, "a rule that is saved again does not wait longer"
    with unit_of_work(sessions) as session:
        session.execute(sa.update(Rules).values(retention_due=datetime.now(UTC)))
    assert removal.due()
    removal.remove()
    assert not removal.due()
    assert lab.save()["due_at"] is None


def test_each_removal_is_an_entry_of_the_audit_log(lab: Laboratory, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "BATCH", 3)
    before = {entry.number for entry in lab.entries()}
    lab.save(days=1)
    assert lab.remove() == 5
    entries = [entry for entry in lab.entries() if entry.number not in before]
    details = [entry.details for entry in entries]
    assert [entry.action for entry in entries] == ["retention.save", "retention.removed", "retention.removed"]
    assert entries[1].who == SERVICE.who
    assert '"bytes":3000' in details[1] and '"recordings":3' in details[1]
    assert all(lab.ids[number - 1] in details[1] for number in (1, 2, 3))
    assert all(lab.ids[number - 1] in details[2] for number in (4, 8))


def test_what_was_annotated_after_the_choice_stays(lab: Laboratory) -> None:
    lab.save(days=250)
    with unit_of_work(app_of(lab.client).state.sessions) as session:
        retention = Retention(session)
        session.add(_note("b", 2))
        assert [row.number for row in retention.rows.locked(retention.rule, datetime.now(UTC), [1, 2])] == [1]
        session.rollback()


def test_files_that_a_removal_has_left_go_with_the_next_one(lab: Laboratory, monkeypatch: pytest.MonkeyPatch) -> None:
    lab.save(days=350)
    store = store_of(app_of(lab.client).state.settings)
    with monkeypatch.context() as silent:
        silent.setattr(type(store), "delete", _fails)
        lab.remove()
    assert 1 in lab.left(), "the row says so, the file could not be deleted"
    lab.remove()
    assert lab.left() == list(range(2, 10))


def _fails(*_: Any) -> None:
    raise OSError("the store does not answer")


@pytest.mark.parametrize(
    ("rule", "where"),
    [({"days": 0}, "days"), ({"gigabytes": -1}, "gigabytes"), ({"states": ["running"]}, "states.0"), ({"weeks": 1}, "weeks")],
)
def test_a_wrong_rule_is_refused_in_words(lab: Laboratory, rule: dict[str, Any], where: str) -> None:
    answer = lab.client.put(RETENTION, json=EVERY | rule)
    assert (answer.status_code, answer.json()["errors"][0]["where"]) == (422, where)


def test_the_command_line_previews_and_removes(lab: Laboratory, capsys: pytest.CaptureFixture[str]) -> None:
    lab.save(days=350)
    data, before = ["--data", str(app_of(lab.client).state.settings.data)], len(lab.entries())
    assert main(["retention", "--dry-run", *data]) == 0
    told = capsys.readouterr().out
    assert "The rule removes 1 recording now, 0.0 MB." in told and "#1 Brace 1" in told
    assert 1 in lab.left()
    assert main(["retention", *data]) == 0
    assert "Removed 1 recording, 0.0 MB." in capsys.readouterr().out
    assert lab.left() == list(range(2, 10))
    acted = lab.entries()[before:]
    assert [entry.action for entry in acted] == ["retention.removed", "rths retention"]
    assert {entry.signed_in for entry in acted} == {"command line"}
