"""A control room with accounts, and people who are signed in: fixtures and helpers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from argon2 import PasswordHasher
from fastapi.testclient import TestClient

from app.access import Role
from app.accounts import passwords
from app.accounts.service import AccountService
from app.accounts.throttle import Throttle
from app.config import Settings
from app.db import unit_of_work
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, app_of

PASSWORD = "correct horse battery"
COOKIE = "rths-session-8000"
V1 = "/api/v1"

Person = Callable[..., TestClient]


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A control room with accounts, and cheap hashes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(passwords, "HASHER", PasswordHasher(time_cost=1, memory_cost=8, parallelism=1))
        settings = Settings(data=tmp_path_factory.mktemp("accounts"), embedded_worker=False)
        with TestClient(create_app(settings), ADDRESS, client=HERE, raise_server_exceptions=False) as one:
            yield one


@pytest.fixture
def browser(lab: TestClient) -> Callable[..., TestClient]:
    """A new browser, at an address of its own."""
    app_of(lab).state.throttle = Throttle()
    return lambda address="192.0.2.1": TestClient(app_of(lab), ADDRESS, client=(address, 1), raise_server_exceptions=False)


@pytest.fixture
def person(lab: TestClient, browser: Callable[..., TestClient], request: pytest.FixtureRequest) -> Person:
    """A signed-in person with an account of this test."""

    def made(role: Role, name: str = "") -> TestClient:
        name = name or f"{role.name.title()} of {request.node.name[:50]}"
        with unit_of_work(app_of(lab).state.sessions) as session:
            AccountService(session).add(name, role, PASSWORD)
        one = browser()
        assert sign_in(one, name).status_code == 204
        return one

    return made


def sign_in(client: TestClient, name: str, password: str = PASSWORD) -> Any:
    return client.post(f"{V1}/sign-in", json={"name": name, "password": password})


def name_of(client: TestClient) -> str:
    found: str = client.get(f"{V1}/account").json()["name"]
    return found
