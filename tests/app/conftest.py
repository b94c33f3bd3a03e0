"""The service without a worker, for REST tests, and with one in its own process, for tests of the queue."""

from __future__ import annotations

import os
import shutil
import tarfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from app import db
from app.config import Settings
from app.jobs import queue
from app.main import create_app
from rths_engine.planning import templates
from tests.app import postgres
from tests.browser.service import Service, running

ARCHIVE = Path(__file__).parents[1] / "data" / "earlier_build_0_1_0.tar.xz"
ADDRESS = "http://127.0.0.1:8000"
HERE = ("127.0.0.1", 50_000)  # address of a client on this computer


@pytest.fixture(scope="session")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty database, migrated once and copied for each test."""
    settings = Settings(data=tmp_path_factory.mktemp("migrated")).prepared()
    db.migrate(settings.url)
    queue.migrate(settings.url)
    return settings.data / "rths.sqlite"


@pytest.fixture
def settings(tmp_path: Path, migrated: Path) -> Settings:
    shutil.copytree(migrated.parent, tmp_path / "rths")
    return Settings(data=tmp_path / "rths", embedded_worker=False, local_sign_in=True)


@pytest.fixture
def client(settings: Settings) -> Iterator[TestClient]:
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as one:
        yield one


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(tmp_path_factory.mktemp("app")) as one:
        yield one


@pytest.fixture(scope="module")
def database() -> Iterator[str]:
    """The URL of a PostgreSQL server of this module's tests; in CI a missing server is a failure."""
    reason = postgres.missing()
    if reason and os.environ.get("CI"):
        pytest.fail(reason)
    if reason:
        pytest.skip(reason)
    with postgres.server() as url:
        yield url


@pytest.fixture(scope="module")
def serving(tmp_path_factory: pytest.TempPathFactory, migrated: Path) -> Iterator[TestClient]:
    """One service without a worker for all tests of a module, which put back what they change."""
    folder = tmp_path_factory.mktemp("serving") / "rths"
    shutil.copytree(migrated.parent, folder)
    app = create_app(Settings(data=folder, embedded_worker=False, local_sign_in=True))
    with TestClient(app, ADDRESS, client=HERE, raise_server_exceptions=False) as one:
        yield one


def app_of(client: TestClient) -> FastAPI:
    """The application that a client asks."""
    assert isinstance(client.app, FastAPI)
    return client.app


def unpack_earlier(folder: Path) -> Path:
    """The data folder that version 0.1.0 wrote, tests/data/README.md."""
    with tarfile.open(ARCHIVE) as packed:
        packed.extractall(folder, filter="data")
    return folder / "rths"


@pytest.fixture(scope="module")
def earlier(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """Files of version 0.1.0 under today's service, migrated: rows in every state; no worker takes what waits."""
    settings = Settings(data=unpack_earlier(tmp_path_factory.mktemp("earlier")), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        yield client


def plan(**changes: Any) -> dict[str, Any]:
    """Simulation 4 of Table III, 2 s of it, with some of it changed."""
    return {**templates.template("two-storeys").as_dict(), "duration": 2.0, **changes}
