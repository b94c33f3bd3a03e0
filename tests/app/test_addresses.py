"""Addresses of people who sign in: which of them are slowed down, and whose word about an address is believed."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from fastapi.testclient import TestClient

from app.access import Role
from app.cli.serve import PROXIES, Server
from tests.app.conftest import ADDRESS, app_of
from tests.app.people import V1, Person, browser, lab, name_of, person, sign_in

__all__ = ["browser", "lab", "person"]  # fixtures


def test_wrong_passwords_for_any_names_from_an_address_do_not_slow_down_who_has_signed_in_from_it(
    person: Person, browser: Callable[..., TestClient]
) -> None:
    owner = name_of(person(Role.VIEWER))
    visitor = browser()  # at the same address
    statuses = [sign_in(visitor, f"nobody {number}", "a wrong guess").status_code for number in range(31)]
    assert statuses == [401] * 30 + [429]
    assert sign_in(browser(), owner).status_code == 204
    assert sign_in(browser("198.51.100.7"), owner).status_code == 204  # and no other address


def test_wrong_passwords_of_people_at_a_known_address_do_not_slow_down_newcomers_there(
    person: Person, browser: Callable[..., TestClient]
) -> None:
    people = [name_of(person(Role.VIEWER, f"Known Person {letter}")) for letter in "abcdefg"]
    for name in people:
        assert [sign_in(browser(), name, "a wrong guess").status_code for _ in range(6)] == [401] * 5 + [429]
    assert sign_in(browser(), "newcomer", "a wrong guess").status_code == 401


@pytest.mark.parametrize(
    ("proxies", "peer", "believed"),
    [
        (None, "127.0.0.1", False),
        (None, "::1", False),
        ("", "127.0.0.1", False),
        ("10.0.0.5", "127.0.0.1", False),
        ("10.0.0.5", "10.0.0.5", True),
        ("10.0.0.0/24,127.0.0.1", "127.0.0.1", True),
    ],
)
def test_an_address_is_believed_from_named_proxies_only(
    lab: TestClient,
    browser: Callable[..., TestClient],
    monkeypatch: pytest.MonkeyPatch,
    proxies: str | None,
    peer: str,
    believed: bool,
) -> None:
    browser()  # counts anew
    monkeypatch.delenv(PROXIES, raising=False)
    if proxies is not None:
        monkeypatch.setenv(PROXIES, proxies)
    config = Server(app_of(lab), app_of(lab).state.settings, demonstrate=False).config
    config.load()
    through = TestClient(config.loaded_app, ADDRESS, client=(peer, 1), raise_server_exceptions=False)
    for number in range(6):
        forged = {"x-forwarded-for": f"198.51.100.{number}"}
        asked = {"name": "guessed", "password": "a wrong guess"}
        last = through.post(f"{V1}/sign-in", json=asked, headers=forged).status_code
    assert last == (401 if believed else 429)
