"""Migrations, up and down, of databases of every earlier version with rows: nothing is lost that the older schema can hold."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
import sqlalchemy as sa
from alembic import command
from alembic.config import Config
from alembic.script import ScriptDirectory

from app import db
from app.cli.main import main
from tests.app import postgres
from tests.app.rows_of_revisions import Snapshot, common, fill, lost, reflected, snapshot

MIGRATIONS = ScriptDirectory.from_config(db.alembic_config(""))
REVISIONS = [one.revision for one in MIGRATIONS.walk_revisions()][::-1]


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    if request.param == "sqlite":
        yield f"sqlite:///{tmp_path / 'rths.sqlite'}"
    elif postgres.missing():
        pytest.skip(str(postgres.missing()))
    else:
        with postgres.server() as server:
            yield server


def test_rows_of_every_version_come_through_every_migration_up_and_down(url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ScriptDirectory, "from_config", lambda config: MIGRATIONS)  # each command would read every file again
    config, engine = db.alembic_config(url), db.connect(url)
    try:
        _walk(config, engine)
    finally:
        engine.dispose()


def _walk(config: Config, engine: sa.Engine) -> None:
    stood: dict[str, Snapshot] = {}
    for revision in REVISIONS:
        command.upgrade(config, revision)
        fill(engine)
        stood[revision] = snapshot(engine)
    for revision in reversed(REVISIONS[:-1]):
        command.downgrade(config, revision)
        assert lost(stood[revision], snapshot(engine)) == [], f"down to {revision}"
    oldest = snapshot(engine)
    for revision in REVISIONS[1:]:
        command.upgrade(config, revision)
        assert lost(common(stood[revision], oldest), snapshot(engine)) == [], f"up to {revision}"


def test_names_of_accounts_with_more_spaces_stay_apart(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'rths.sqlite'}"
    config, engine = db.alembic_config(url), db.connect(url)
    command.upgrade(config, "0029")
    fill(engine)
    account = reflected(engine).tables["account"]
    with engine.begin() as connection:
        first = dict(connection.execute(sa.select(account)).mappings().one())
        for number, name in enumerate(("Ola  Operator", "Ola Operator", "Eng\t Neer")):
            row = {**first, "id": f"{number}", "name": name, "key": name.casefold()}
            connection.execute(sa.insert(account), row)
    command.upgrade(config, "0030")
    with engine.connect() as connection:
        found = {row.id: (row.name, row.key) for row in connection.execute(sa.select(account))}
    engine.dispose()
    assert found["0"] == ("Ola Operator (2)", "ola operator (2)") and found["1"] == ("Ola Operator", "ola operator")
    assert found["2"] == ("Eng Neer", "eng neer")


def test_an_earlier_schema_is_taken_only_after_saying_what_it_loses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    url = f"sqlite:///{tmp_path / 'rths.sqlite'}"
    db.migrate(url)
    engine = db.connect(url)
    fill(engine)
    engine.dispose()
    assert main(["migrate", "--data", str(tmp_path), "--to", "0013"]) == 2
    said = capsys.readouterr().err
    assert "1 rows of annotation" in said and "run.client" in said and "rths backup" in said
    assert db.schemas(url)[0] == REVISIONS[-1]
    assert main(["migrate", "--data", str(tmp_path), "--to", "0013", "--accept-loss"]) == 0
    assert "The database has schema 0013. Lost: " in capsys.readouterr().out and db.schemas(url)[0] == "0013"
    assert main(["migrate", "--data", str(tmp_path)]) == 0 and db.schemas(url)[0] == REVISIONS[-1]


def test_a_schema_that_does_not_exist_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    db.migrate(f"sqlite:///{tmp_path / 'rths.sqlite'}")
    assert main(["migrate", "--data", str(tmp_path), "--to", "9999"]) == 2
    assert "is not a schema of this version (0001 to" in capsys.readouterr().err
