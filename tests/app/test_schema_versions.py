"""A worker and a database of different versions of the program: the worker says what to do, and does not start."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import sqlalchemy as sa
from alembic import command

from app import db
from app.cli.main import main
from app.config import Settings
from app.worker.main import main as start_worker
from rths_engine.foundation.errors import RthsError


@pytest.fixture
def url(tmp_path: Path, migrated: Path) -> str:
    shutil.copytree(migrated.parent, tmp_path / "rths")
    return Settings(data=tmp_path / "rths").url


def stamp(url: str, revision: str) -> None:
    engine = db.connect(url)
    with engine.begin() as connection:
        connection.execute(sa.text("update alembic_version set version_num = :revision"), {"revision": revision})
    engine.dispose()


def test_a_database_of_this_version_is_accepted(url: str) -> None:
    db.check_schema(url)


def test_a_worker_does_not_start_on_an_older_database(url: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command.downgrade(db.alembic_config(url), "-1")
    assert main(["worker", "--data", str(tmp_path / "rths")]) == 2
    assert "older version of the program" in (told := capsys.readouterr().err) and "rths migrate" in told
    with pytest.raises(SystemExit, match="older version"):
        start_worker(["--data", str(tmp_path / "rths")])


def test_a_worker_does_not_start_without_a_database(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["worker", "--data", str(tmp_path)]) == 2
    assert "has no database" in (told := capsys.readouterr().err) and "rths migrate" in told


def test_nothing_of_this_version_starts_on_a_newer_database(
    url: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stamp(url, "9999")
    for words in ("worker", "migrate"):
        assert main([words, "--data", str(tmp_path / "rths")]) == 2
        assert "database = 9999: has the schema of a newer version of the program" in capsys.readouterr().err
    with pytest.raises(RthsError, match="install that version here too"):
        db.migrate(url)
