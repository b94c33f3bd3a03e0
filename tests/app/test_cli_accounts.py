"""`rths account` and `rths token`, and the link that `rths serve` prints before there is an account."""

from __future__ import annotations

import re
import socket
from dataclasses import replace
from pathlib import Path

import pytest
from argon2 import PasswordHasher
from fastapi.testclient import TestClient

from app.accounts import passwords
from app.cli.main import main
from app.cli.serve import _first, address
from app.config import Settings
from app.main import create_app
from tests.app.conftest import ADDRESS, app_of

Printed = pytest.CaptureFixture[str]


@pytest.fixture
def data(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(passwords, "HASHER", PasswordHasher(time_cost=1, memory_cost=8, parallelism=1))
    return settings.data


def rths(printed: Printed, data: Path, *arguments: str, code: int = 0) -> str:
    assert main([*arguments, "--data", str(data)]) == code
    said = printed.readouterr()
    return said.err if code else said.out


def test_accounts_and_tokens_are_managed_without_a_browser(data: Path, capsys: Printed) -> None:
    assert "no account yet" in rths(capsys, data, "account", "list")
    assert rths(capsys, data, "account", "link").startswith("http://127.0.0.1:8000/sign-in/link#")
    link = rths(capsys, data, "account", "add", "Ana Ruiz", "--role", "engineer", "--url", "https://lab.example/")
    key = link.partition("#")[2].partition("\n")[0]
    assert link.startswith("https://lab.example/sign-in/link#") and "works once" in link
    assert "Ana Ruiz" in (listed := rths(capsys, data, "account", "list")) and "has no password yet" in listed
    assert "There are accounts already" in rths(capsys, data, "account", "link", code=2)
    assert "belongs to another account" in rths(capsys, data, "account", "add", "ana ruiz", code=2)
    assert "no account Eve" in rths(capsys, data, "account", "password-link", "Eve", code=2)
    new = rths(capsys, data, "account", "password-link", "Ana Ruiz").partition("#")[2].partition("\n")[0]
    with TestClient(create_app(Settings(data=data, embedded_worker=False)), ADDRESS) as browser:
        stale = browser.post("/api/v1/sign-in/link", json={"key": key, "password": "three long words"})
        assert stale.status_code == 404
        assert browser.post("/api/v1/sign-in/link", json={"key": new, "password": "three long words"}).status_code == 204
        assert "goes beyond the role" in rths(capsys, data, "token", "add", "Ana Ruiz", "x", "--scope", "administer", code=2)
        said = rths(capsys, data, "token", "add", "Ana Ruiz", "nightly sweep", "--scope", "read", "--scope", "submit")
        token = said.splitlines()[0]
        assert token.startswith("rths_") and "not shown again" in said
        program = TestClient(app_of(browser), ADDRESS, headers={"authorization": f"Bearer {token}"})
        assert program.get("/api/v1/account").json() | {"how": ""} == {
            "name": "Ana Ruiz",
            "role": "engineer",
            "how": "",
            "scopes": ["read", "submit"],
        }
        tokens = rths(capsys, data, "token", "list", "Ana Ruiz")
        assert token not in tokens and "nightly sweep" in tokens
        assert "operator" in rths(capsys, data, "account", "role", "Ana Ruiz", "operator")
        rths(capsys, data, "token", "revoke", "Ana Ruiz", tokens.split()[0])
        app_of(browser).state.credentials.renew()  # as every 15 s
        assert program.get("/api/v1/account").status_code == 401 and browser.get("/api/v1/account").status_code == 200
        rths(capsys, data, "account", "disable", "Ana Ruiz")
        app_of(browser).state.credentials.renew()
        assert browser.get("/api/v1/account").status_code == 401
        assert "disabled" in rths(capsys, data, "account", "list")
        rths(capsys, data, "account", "disable", "Ana Ruiz", "--undo")
        assert rths(capsys, data, "token", "list", "Ana Ruiz").startswith("Ana Ruiz has no API token")


def test_the_first_start_prints_a_link_and_later_ones_do_not(data: Path, capsys: Printed) -> None:
    settings = Settings(data=data, embedded_worker=False)
    with TestClient(create_app(settings), ADDRESS) as browser:
        said = _first(app_of(browser), settings)
        assert re.match(r"First administrator: http://127\.0\.0\.1:8000/sign-in/link#\S{43}\nThe link works once", said)
        rths(capsys, data, "account", "add", "Ana Ruiz")
        assert _first(app_of(browser), settings) == ""


def test_the_first_link_of_a_service_on_a_network_is_also_printed_for_other_computers(
    data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(socket, "gethostname", lambda: "Control-Room")
    settings = Settings(data=data, embedded_worker=False)
    with TestClient(create_app(settings), ADDRESS) as browser:
        said = _first(app_of(browser), replace(settings, host="0.0.0.0"))
        link, other, _ = said.splitlines()
        path = link.removeprefix("First administrator: http://127.0.0.1:8000")
        assert other == f"From another computer: http://control-room:8000{path}"
    assert address(replace(settings, host="::", hosts=("lab.example",)), elsewhere=True) == "http://lab.example:8000/"
    assert address(replace(settings, host="192.0.2.8"), elsewhere=True) == address(replace(settings, host="192.0.2.8"))
