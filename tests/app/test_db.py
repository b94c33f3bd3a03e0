"""Schema, migration and connections of the database."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from threading import Barrier

import pytest
import sqlalchemy as sa
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext

from app import db
from app.db import Base
from app.jobs.tables import QueueState, WorkerHeartbeat
from app.jobs.workers import Workers
from app.models import RunStation


@pytest.fixture
def url(tmp_path: Path) -> str:
    url = f"sqlite:///{tmp_path / 'rths.sqlite'}"
    db.migrate(url)
    return url


def differences(url: str) -> list[object]:
    engine = db.connect(url)
    with engine.connect() as connection:
        found: list[object] = compare_metadata(MigrationContext.configure(connection), Base.metadata)
    engine.dispose()
    return found


def test_the_migrated_schema_is_the_models(url: str) -> None:
    assert differences(url) == []


def test_a_forgotten_migration_would_be_seen(url: str) -> None:
    engine = db.connect(url)
    with engine.begin() as connection:
        connection.execute(sa.text("alter table run add column forgotten integer"))
    engine.dispose()
    assert differences(url)


def test_the_migration_goes_down_and_up_again_from_any_folder(
    url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    command.downgrade(db.alembic_config(url), "base")
    engine = db.connect(url)
    assert sa.inspect(engine).get_table_names() == ["alembic_version"]
    engine.dispose()
    db.migrate(url)
    assert differences(url) == []


def test_runs_measured_before_a_migration_keep_what_was_measured(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'old.sqlite'}"
    command.upgrade(db.alembic_config(url), "0001")
    engine = db.connect(url)
    text = dict.fromkeys(("id", "name", "digest", "code_version", "submitted_by"), "old")
    numbers = {"number": 7, "plan": {}, "seed": 0, "attempt": 1, "duration_s": 1.0}
    tables = sa.MetaData()
    tables.reflect(engine)
    with engine.begin() as connection:
        run = {**text, **numbers, "state": "completed", "submitted_at": datetime.now(UTC)}
        connection.execute(sa.insert(tables.tables["run"]).values(run))
        row = {"run_number": 7, "number": 1, "name": "damper", "mte_mm": 2.5}
        connection.execute(sa.insert(tables.tables["run_station"]).values(row))
    db.migrate(url)
    with db.unit_of_work(db.sessions(engine)) as session:
        station = session.scalars(sa.select(RunStation)).one()
        assert (station.name, station.measure("mte_mm"), station.measure("fei_delay_ms")) == ("damper", 2.5, None)
    engine.dispose()


def test_a_database_migrated_already_keeps_its_rows(url: str) -> None:
    engine = db.connect(url)
    with db.unit_of_work(db.sessions(engine)) as session:
        session.get_one(QueueState, 1).held_by = "Ana"
    db.migrate(url)
    with db.unit_of_work(db.sessions(engine)) as session:
        assert session.get_one(QueueState, 1).held_by == "Ana"
    engine.dispose()


def test_every_connection_has_write_ahead_logging_foreign_keys_and_patience(url: str) -> None:
    engine = db.connect(url)
    with engine.connect() as first, engine.connect() as second:
        for connection in (first, second):
            asked = {
                name: connection.scalar(sa.text(f"pragma {name}")) for name in ("journal_mode", "foreign_keys", "busy_timeout")
            }
            assert asked == {"journal_mode": "wal", "foreign_keys": 1, "busy_timeout": db.BUSY_TIMEOUT_MS}
    engine.dispose()


def test_measures_of_a_run_that_is_not_there_are_refused(url: str) -> None:
    engine = db.connect(url)
    with pytest.raises(sa.exc.IntegrityError), db.unit_of_work(db.sessions(engine)) as session:
        session.add(RunStation(run_number=1, number=1, name="nobody's"))
    engine.dispose()


def test_heartbeats_for_a_new_worker_at_the_same_moment_are_all_stored(url: str) -> None:
    engine, together = db.connect(url), Barrier(4)

    def beats(number: int) -> None:
        for worker in range(20):
            together.wait(60)
            with db.unit_of_work(db.sessions(engine)) as session:
                Workers(session).beat(f"worker {worker}", number)

    with ThreadPoolExecutor(4) as threads:
        list(threads.map(beats, range(4)))
    with db.unit_of_work(db.sessions(engine)) as session:
        assert len(Workers(session).beats()) == 20
    engine.dispose()


def test_times_of_any_zone_come_back_as_the_same_instant_in_utc(url: str) -> None:
    engine = db.connect(url)
    given = datetime(2026, 11, 23, 1, 30, tzinfo=timezone(timedelta(hours=9)))
    with db.unit_of_work(db.sessions(engine)) as session:
        session.add(WorkerHeartbeat(worker="one", seen_at=given))
    with db.unit_of_work(db.sessions(engine)) as session:
        found = session.get_one(WorkerHeartbeat, "one").seen_at
    engine.dispose()
    assert found == given and found.tzinfo is UTC


def test_an_error_inside_a_unit_of_work_stores_nothing(url: str) -> None:
    engine = db.connect(url)
    with pytest.raises(ZeroDivisionError), db.unit_of_work(db.sessions(engine)) as session:
        session.add(WorkerHeartbeat(worker="one", seen_at=datetime.now(UTC)))
        session.flush()
        raise ZeroDivisionError
    with db.unit_of_work(db.sessions(engine)) as session:
        assert session.get(WorkerHeartbeat, "one") is None
    engine.dispose()
