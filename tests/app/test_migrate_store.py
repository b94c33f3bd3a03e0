"""`rths migrate-store`: nothing is lost, moved twice or renumbered between SQLite with a folder and PostgreSQL with a store."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fsspec
import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.cli.main import UNUSABLE, main
from app.config import Settings
from app.db import connect
from app.main import create_app
from app.moving import files
from app.moving.places import using
from app.store.opening import opened
from tests.app import postgres
from tests.app.conftest import ADDRESS, HERE, unpack_earlier
from tests.app.test_earlier_files import rows
from tests.app.test_runs_api import submit

STORE = "memory://bucket/moved"


@pytest.fixture(scope="module")
def server() -> Iterator[str]:
    reason = postgres.missing()
    if reason:
        pytest.skip(reason)
    with postgres.server() as url:
        yield url


@pytest.fixture
def database(server: str, request: pytest.FixtureRequest) -> Iterator[str]:
    """An empty database of the server."""
    name = f"moved_{abs(hash(request.node.name))}"
    engine = sa.create_engine(server.replace("postgresql:", "postgresql+psycopg:"), isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:
        connection.execute(sa.text(f"create database {name}"))
    engine.dispose()
    yield f"{server.rpartition('/')[0]}/{name}"
    fsspec.filesystem("memory").store.clear()
    opened.cache_clear()


def contents(folder: Path) -> dict[str, str]:
    """Path and checksum of every file of a data folder that a move could change; a lock file is empty."""
    found = (path for path in folder.rglob("*") if path.is_file() and path.stat().st_size)
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in found}


def listed(client: TestClient) -> Any:
    kinds = ("runs", "recordings", "diagnoses")
    return {kind: {row["id"]: row for row in rows(client, kind).values()} for kind in kinds}


def test_files_of_an_earlier_version_move_to_postgresql_and_a_store_and_back(database: str, tmp_path: Path) -> None:
    folder = unpack_earlier(tmp_path / "source")
    before = contents(folder)
    there = ["--to-database", database, "--to-store", STORE]
    assert main(["migrate-store", "--from", str(folder), *there]) == 0
    assert contents(folder) == before
    moved = Settings(data=tmp_path / "replica", database_url=database, store=STORE, embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(moved), ADDRESS, client=HERE) as client:
        found = listed(client)
        run = rows(client, "runs")["Completed"]
        answer = client.get(f"/api/v1/runs/{run['id']}/recording.h5")
        assert answer.status_code == 200 and hashlib.sha256(answer.content).hexdigest() == run["recording"]["sha256"]
        assert rows(client, "runs")["Queued"]["state"] == "queued"
        new = submit(client)
        assert client.get(f"/api/v1/runs/{new}").json()["number"] == 1 + max(one["number"] for one in found["runs"].values())
    assert waiting(f"sqlite:///{folder / 'rths.sqlite'}") < waiting(database, "dbos.")
    back = tmp_path / "back"
    back.mkdir()  # a folder that no service has opened
    source = ["--from-database", database, "--from-store", STORE]
    assert main(["migrate-store", *source, "--to", str(back)]) == 0
    assert not [one for one in back.rglob("*") if one.stat().st_mode & 0o077]
    with TestClient(create_app(Settings(data=back, embedded_worker=False, local_sign_in=True)), ADDRESS, client=HERE) as client:
        again = listed(client)
        again["runs"].pop(new)
        assert again == found
    before_files = {name: checksum for name, checksum in before.items() if name.startswith(("recordings", "measured"))}
    assert before_files.items() <= contents(back).items()


def waiting(database: str, schema: str = "") -> set[str]:
    """The deliveries that wait in the durable queue."""
    engine = connect(database)
    with engine.connect() as connection:
        query = f"select workflow_uuid from {schema}workflow_status where status = 'ENQUEUED'"
        found = set(connection.scalars(sa.text(query)))
    engine.dispose()
    return found


def test_a_move_that_was_interrupted_goes_on_and_one_into_a_full_database_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    target = str(tmp_path / "target")
    command = ["migrate-store", "--from", str(unpack_earlier(tmp_path / "source")), "--to", target]

    def cut(*_: Any) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as interrupted:
        interrupted.setattr(files, "copy", cut)
        assert main(command) == 130
    assert main(["migrate-store", "--from", str(unpack_earlier(tmp_path / "other")), "--to", target]) == UNUSABLE
    assert "is the target of a move from" in capsys.readouterr().err
    assert main(command) == 0
    assert main(command) == UNUSABLE
    assert "has rows already" in capsys.readouterr().err


def test_what_would_lose_something_is_refused_before_the_first_change(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = unpack_earlier(tmp_path / "source")
    target = tmp_path / "target"
    command = ["migrate-store", "--from", str(folder), "--to", str(target)]
    with using(Settings(data=folder)):
        assert main(command) == UNUSABLE
    assert "a web service or a worker uses it" in capsys.readouterr().err
    path = next(folder.glob("recordings/*.h5"))
    content = path.read_bytes()
    path.write_bytes(content[:-1])
    assert main(command) == UNUSABLE
    assert "is damaged" in capsys.readouterr().err and not list(target.glob("recordings/*"))
    path.write_bytes(content)
    engine = sa.create_engine(f"sqlite:///{folder / 'rths.sqlite'}")
    with engine.begin() as connection:
        connection.execute(sa.text("update run set state = 'running' where state = 'queued'"))
    assert main(command) == UNUSABLE
    assert "has 1 running jobs" in capsys.readouterr().err and not list(target.glob("recordings/*"))


@pytest.mark.parametrize(
    "given",
    [
        [],
        ["--from", "a"],
        ["--from", "a", "--to", "b", "--to-store", "file:///c"],
        ["--from", "a", "--to-database", "sqlite:///b"],
    ],
)
def test_both_ends_of_a_move_are_needed(given: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["migrate-store", *given]) == UNUSABLE
    assert "--" in capsys.readouterr().err
