"""Backups: rows and files of one moment, restored whole into an empty place of either kind of database, or refused."""

from __future__ import annotations

import json
import os
import shutil
import threading
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app import db
from app.backup import manifest, snapshot
from app.backup.making import Made, make
from app.backup.restoring import restore
from app.backup.verifying import verify
from app.cli.main import main
from app.config import Settings
from app.events.log import EventLog
from app.events.tables import Event, EventKind
from app.main import create_app
from app.moving.rows import Rows, tables
from rths_engine.foundation.errors import RthsError
from tests.app import postgres
from tests.app.conftest import ADDRESS, HERE, app_of, unpack_earlier


def quiet(_: str) -> None:
    """Progress that nobody watches."""


def opened(settings: Settings) -> TestClient:
    return TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False)


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A running service with the data of version 0.1.0 and an audit log."""
    settings = Settings(data=unpack_earlier(tmp_path_factory.mktemp("lab")), embedded_worker=False, local_sign_in=True)
    with opened(settings) as client:
        client.post("/api/v1/queue/hold", json={"by": "Ana Ruiz", "reason": "oil"})
        yield client


@pytest.fixture(scope="module")
def made(lab: TestClient, tmp_path_factory: pytest.TempPathFactory) -> Made:
    return make(settings_of(lab), tmp_path_factory.mktemp("backups"), quiet)


@pytest.fixture
def copied(made: Made, tmp_path: Path) -> Path:
    """A copy of the backup, to be damaged."""
    return shutil.copytree(made.folder, tmp_path / "backup")


def settings_of(client: TestClient) -> Settings:
    found: Settings = app_of(client).state.settings
    return found


def contents(url: str) -> dict[str, list[Any]]:
    """Every row of every table."""
    engine = db.connect(url)
    rows = Rows(engine)
    found = {one.name: [row for batch in rows.batches(one) for row in batch] for one in tables()}
    engine.dispose()
    return found


def checksums(folder: Path) -> dict[str, bytes]:
    found = (path for name in ("recordings", "measured", "motions") for path in sorted((folder / name).rglob("*")))
    return {str(path.relative_to(folder)): path.read_bytes() for path in found if path.is_file()}


def test_a_backup_of_a_running_service_restores_the_same_runs_files_and_audit_log(
    lab: TestClient, made: Made, tmp_path: Path
) -> None:
    there = Settings(data=tmp_path / "new", embedded_worker=False, local_sign_in=True)
    restore(there, made.folder, quiet)
    assert contents(there.url) == contents(f"sqlite:///{made.folder / manifest.DATABASE}")
    assert checksums(there.data) == checksums(settings_of(lab).data) and len(checksums(there.data)) > 5
    assert made.manifest.audit["number"] > 0 and not verify(there).damaged
    with opened(there) as client:
        for path in ("/api/v1/runs", "/api/v1/recordings", "/api/v1/diagnoses", "/api/v1/queue"):
            known, found = lab.get(path).json(), client.get(path).json()
            assert {**found, "now": 0} == {**known, "now": 0}, path
        run = client.get("/api/v1/runs?state=completed").json()["runs"][0]["id"]
        assert client.get(f"/api/v1/runs/{run}/recording.h5").content == lab.get(f"/api/v1/runs/{run}/recording.h5").content


def test_the_next_backup_links_the_files_that_have_not_changed(lab: TestClient, made: Made) -> None:
    again = make(settings_of(lab), made.folder.parent, quiet)
    kept = [name for name in again.manifest.files if name.startswith("recordings/")]
    assert again.linked >= len(kept) > 0 and again.folder != made.folder
    for name in kept:
        assert os.path.samefile(again.folder / name, made.folder / name)
    manifest.check(again.folder, again.manifest)


def damage(folder: Path, name: str) -> None:
    path = folder / name
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.unlink()  # other backups may share the file
    path.write_bytes(data)


def shorten(folder: Path, name: str) -> None:
    data = (folder / name).read_bytes()
    (folder / name).unlink()
    (folder / name).write_bytes(data[:-1])


@pytest.mark.parametrize("harm", [damage, shorten, lambda folder, name: (folder / name).unlink()])
@pytest.mark.parametrize("what", ["recordings/", manifest.DATABASE, manifest.NAME])
def test_a_damaged_backup_is_refused_with_the_file_named(
    copied: Path, what: str, harm: Callable[[Path, str], None], tmp_path: Path
) -> None:
    name = next(one for one in (*manifest.read(copied).files, manifest.NAME) if one.startswith(what))
    harm(copied, name)
    with pytest.raises(RthsError) as refused:
        restore(Settings(data=tmp_path / "new"), copied, quiet)
    assert name in str(refused.value) and not (tmp_path / "new").exists()


def test_a_manifest_that_names_a_file_outside_the_backup_is_refused(copied: Path) -> None:
    found = manifest.read(copied)
    found.files["../outside"] = manifest.Kept("0" * 64, 1)
    found.write(copied)
    with pytest.raises(RthsError, match=r"not a file of the backup: \.\./outside"):
        manifest.read(copied)


def test_a_backup_that_was_interrupted_is_not_complete(copied: Path, tmp_path: Path) -> None:
    (copied / manifest.SEAL).unlink()
    with pytest.raises(RthsError, match="is not complete"):
        restore(Settings(data=tmp_path / "new"), copied, quiet)


def test_a_restoration_overwrites_nothing(lab: TestClient, made: Made, tmp_path: Path) -> None:
    before = checksums(settings_of(lab).data)
    with pytest.raises(RthsError, match=r"has \d+ files already"):
        restore(settings_of(lab), made.folder, quiet)
    assert checksums(settings_of(lab).data) == before
    (tmp_path / "rths.sqlite").touch()
    with pytest.raises(RthsError, match="exists already"):
        restore(Settings(data=tmp_path), made.folder, quiet)


def test_rows_and_files_of_a_backup_are_of_one_moment_while_others_write(lab: TestClient, tmp_path: Path) -> None:
    settings, stop = settings_of(lab), threading.Event()
    engine = db.connect(settings.url)
    maker = db.sessions(engine)

    def write() -> None:
        while not stop.is_set():
            with db.unit_of_work(maker) as session:  # two rows in each transaction
                for name in ("one", "other"):
                    EventLog(session).add(EventKind.HELD, f"{datetime.now(UTC)}", "test", None, name)

    writer = threading.Thread(target=write)
    writer.start()
    try:
        found = make(settings, tmp_path, quiet)
    finally:
        stop.set()
        writer.join()
    engine.dispose()
    with snapshot.opened(found.folder / manifest.DATABASE) as rows, rows.connect() as connection:
        counts = [connection.scalar(sa.select(sa.func.count()).where(Event.name == name)) for name in ("one", "other")]
    assert counts[0] == counts[1]


def test_a_damaged_file_is_named_and_left_out_of_the_backup(lab: TestClient, made: Made, tmp_path: Path) -> None:
    there = Settings(data=tmp_path / "new", embedded_worker=False)
    restore(there, made.folder, quiet)
    key = next(name for name in made.manifest.files if name.startswith("recordings/"))
    damage(there.data, key)
    (there.data / "recordings" / "nobody.h5").write_bytes(b"x")
    found = verify(there)
    assert list(found.damaged) == [key] and found.without_row == ["recordings/nobody.h5"] and found.good > 3
    again = make(there, tmp_path / "backups", quiet)
    assert list(again.manifest.damaged) == [key] and key not in again.manifest.files


def test_the_commands_say_what_they_did(
    lab: TestClient, tmp_path: Path, capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    data = str(settings_of(lab).data)
    assert main(["backup", str(tmp_path / "backups"), "--data", data]) == 0
    folder, counted = capsys.readouterr().out.splitlines()
    (tmp_path / "new").mkdir(mode=0o755)  # a folder that no service has opened
    assert main(["restore", folder, "--data", str(tmp_path / "new")]) == 0
    assert not [one for one in (tmp_path / "new", *(tmp_path / "new").rglob("*")) if one.stat().st_mode & 0o077]
    assert "is closed to them now" in caplog.text
    restored = capsys.readouterr().out
    assert "The audit log ends with entry" in restored
    assert counted.partition(" (")[0] in restored  # the same numbers of rows and files
    assert main(["verify", "--data", str(tmp_path / "new")]) == 0
    assert "0 are not" in capsys.readouterr().out
    assert main(["restore", folder, "--data", str(tmp_path / "new")]) == 2
    assert "overwrites nothing" in capsys.readouterr().err


@pytest.mark.parametrize("command", [["verify"], ["backup", "TO"], ["migrate-store", "--to", "TO"]])
def test_a_folder_that_no_service_has_opened_is_no_source_and_stays_empty(
    command: list[str], tmp_path: Path, made: Made, capsys: pytest.CaptureFixture[str]
) -> None:
    empty, to = tmp_path / "empty", str(tmp_path / "to")
    empty.mkdir()
    named = "--from" if command[0] == "migrate-store" else "--data"
    assert main([*(to if one == "TO" else one for one in command), named, str(empty)]) == 2
    assert "has no database" in capsys.readouterr().err and list(empty.iterdir()) == []
    restore(Settings(data=empty), made.folder, quiet)


@pytest.mark.skipif(bool(postgres.missing()), reason=str(postgres.missing()))
def test_a_backup_moves_to_the_other_kind_of_database_and_back(made: Made, tmp_path: Path) -> None:
    known = contents(f"sqlite:///{made.folder / manifest.DATABASE}")
    with postgres.server() as url:
        there = Settings(data=tmp_path / "one", database_url=url, embedded_worker=False)
        restore(there, made.folder, quiet)
        assert contents(url) == known
        back = make(there, tmp_path / "backups", quiet)
        with pytest.raises(RthsError, match="has rows already"):
            restore(Settings(data=tmp_path / "two", database_url=url), made.folder, quiet)
    assert back.manifest.audit == made.manifest.audit
    assert back.manifest.files.keys() == made.manifest.files.keys()
    last = Settings(data=tmp_path / "three")
    restore(last, back.folder, quiet)
    assert contents(last.url) == known
    assert json.loads((back.folder / manifest.NAME).read_text())["rows"] == made.manifest.rows
