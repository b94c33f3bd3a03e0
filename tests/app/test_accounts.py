"""Accounts: signing in and out, one-time links, roles, and what happens to a disabled account."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.access import Role
from app.accounts import names, passwords
from app.accounts.service import AccountService
from app.accounts.throttle import Throttle
from app.config import Settings
from app.db import unit_of_work
from app.main import create_app
from app.models import AccountLink, AccountSession
from app.problems import Unavailable
from rths_engine.foundation.errors import RthsError
from tests.app.conftest import ADDRESS, HERE, app_of, plan
from tests.app.people import COOKIE, PASSWORD, V1, Person, browser, lab, name_of, person, sign_in
from tests.browser.service import until

__all__ = ["browser", "lab", "person"]  # fixtures


def test_the_first_administrator_is_made_by_a_link_that_works_once(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data=tmp_path, embedded_worker=False)), ADDRESS, client=HERE) as fresh:
        with unit_of_work(app_of(fresh).state.sessions) as session:
            old, _ = AccountService(session).link()
            path, _ = AccountService(session).link()
        key = path.partition("#")[2]
        assert fresh.post(f"{V1}/sign-in/link/read", json={"key": old.partition("#")[2]}).status_code == 404  # replaced
        assert fresh.post(f"{V1}/sign-in/link/read", json={"key": key}).json() == {
            "makes": "first administrator",
            "name": "",
            "replaces": False,
        }
        short = fresh.post(f"{V1}/sign-in/link", json={"key": key, "name": "Ana Ruiz", "password": "short"})
        assert short.status_code == 422 and "12 to 200 characters" in short.json()["detail"] and "short" not in short.text[60:]
        assert fresh.post(f"{V1}/sign-in/link", json={"key": key, "name": " ", "password": PASSWORD}).status_code == 422
        used = fresh.post(f"{V1}/sign-in/link", json={"key": key, "name": "Ana Ruiz", "password": PASSWORD})
        assert used.status_code == 204
        assert fresh.get(f"{V1}/account").json() == {
            "name": "Ana Ruiz",
            "role": "administrator",
            "how": "session",
            "scopes": None,
        }
        again = fresh.post(f"{V1}/sign-in/link", json={"key": key, "name": "Eve", "password": PASSWORD})
        assert again.status_code == 404
        with unit_of_work(app_of(fresh).state.sessions) as session:
            row = session.scalars(sa.select(AccountSession)).one()
            assert fresh.cookies[COOKIE] not in {row.key_sha256, row.id} and not session.scalars(sa.select(AccountLink)).all()


def test_a_link_that_many_use_at_once_works_once(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data=tmp_path, embedded_worker=False)), ADDRESS, client=HERE) as fresh:
        with unit_of_work(app_of(fresh).state.sessions) as session:
            key = AccountService(session).link()[0].partition("#")[2]

        def use(number: int) -> int:
            sent = {"key": key, "name": f"Admin {number}", "password": PASSWORD}
            answer = fresh.post(f"{V1}/sign-in/link", json=sent)
            return int(answer.status_code)

        with ThreadPoolExecutor(4) as together:
            assert sorted(together.map(use, range(4))) == [204, 404, 404, 404]
        with unit_of_work(app_of(fresh).state.sessions) as session:
            assert len(AccountService(session).listed()) == 1


def test_of_two_administrators_who_lose_the_role_at_once_one_keeps_it(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE) as one:
        with unit_of_work(app_of(one).state.sessions) as session:
            two = [AccountService(session).add(name, Role.ADMINISTRATOR, PASSWORD).id for name in ("Ana", "Eva")]
        with ThreadPoolExecutor(2) as together:
            answers = together.map(lambda account: one.patch(f"{V1}/accounts/{account}", json={"role": "viewer"}), two)
        assert sorted(answer.status_code for answer in answers) == [200, 409]


def test_a_link_expires(person: Person, lab: TestClient, browser: Callable[..., TestClient]) -> None:
    administrator = person(Role.ADMINISTRATOR)
    made = administrator.post(f"{V1}/accounts", json={"name": "Late Comer"}).json()
    with unit_of_work(app_of(lab).state.sessions) as session:
        session.execute(sa.update(AccountLink).values(expires_at=datetime.now(UTC) - timedelta(seconds=1)))
    key = made["path"].partition("#")[2]
    assert browser().post(f"{V1}/sign-in/link", json={"key": key, "password": PASSWORD}).status_code == 404


def test_the_cookie_is_for_this_service_only_and_secure_under_tls(person: Person, lab: TestClient) -> None:
    person(Role.VIEWER, "Cookie Eater")
    plain = sign_in(TestClient(app_of(lab), ADDRESS), "Cookie Eater").headers["set-cookie"]
    assert "HttpOnly" in plain and "SameSite=lax" in plain and "Path=/" in plain and "Secure" not in plain
    secure = sign_in(TestClient(app_of(lab), "https://127.0.0.1:8000"), "cookie EATER").headers["set-cookie"]
    assert "Secure" in secure


def test_signing_in_makes_a_new_key_whatever_cookie_was_sent(person: Person, browser: Callable[..., TestClient]) -> None:
    first = person(Role.VIEWER)
    name, key = name_of(first), first.cookies[COOKIE]
    victim = browser()
    victim.cookies.set(COOKIE, "chosen-by-an-attacker", "127.0.0.1")
    assert sign_in(victim, name).status_code == 204
    assert "chosen-by-an-attacker" not in str(victim.cookies.jar)
    attacker = browser()
    attacker.cookies.set(COOKIE, "chosen-by-an-attacker", "127.0.0.1")
    assert attacker.get(f"{V1}/account").status_code == 401
    assert sign_in(first, name).status_code == 204 and first.cookies[COOKIE] != key


def test_signing_out_ends_the_session_in_the_service_not_only_in_the_browser(
    person: Person, browser: Callable[..., TestClient]
) -> None:
    one = person(Role.VIEWER)
    thief = browser()
    thief.cookies.set(COOKIE, one.cookies[COOKIE], "127.0.0.1")
    assert thief.get(f"{V1}/account").status_code == 200
    assert one.post(f"{V1}/sign-out").status_code == 204 and COOKIE not in one.cookies
    assert thief.get(f"{V1}/account").status_code == 401


def test_a_person_signs_out_everywhere_else_and_changes_the_password(
    person: Person, browser: Callable[..., TestClient]
) -> None:
    one = person(Role.VIEWER)
    name, other = name_of(one), browser()
    sign_in(other, name)
    listed = one.get(f"{V1}/account/sessions").json()["sessions"]
    assert len(listed) == 2 and [each["present"] for each in listed].count(True) == 1
    assert one.delete(f"{V1}/account/sessions").status_code == 204
    assert other.get(f"{V1}/account").status_code == 401 and one.get(f"{V1}/account").status_code == 200
    sign_in(other, name)
    wrong = one.post(f"{V1}/account/password", json={"present": "a wrong password", "password": "another password"})
    assert wrong.status_code == 422 and wrong.json()["errors"][0]["where"] == "present"
    changed = one.post(f"{V1}/account/password", json={"present": PASSWORD, "password": "another password"})
    assert changed.status_code == 204
    assert other.get(f"{V1}/account").status_code == 401 and one.get(f"{V1}/account").status_code == 200
    assert sign_in(browser(), name).status_code == 401 and sign_in(browser(), name, "another password").status_code == 204
    (mine,) = [each for each in one.get(f"{V1}/account/sessions").json()["sessions"] if each["present"]]
    assert one.delete(f"{V1}/account/sessions/{mine['id']}").status_code == 204
    assert one.get(f"{V1}/account").status_code == 401


def test_a_disabled_account_is_out_at_once(person: Person, browser: Callable[..., TestClient]) -> None:
    administrator, engineer = person(Role.ADMINISTRATOR), person(Role.ENGINEER)
    name = name_of(engineer)
    token = engineer.post(f"{V1}/account/tokens", json={"name": "script"}).json()["token"]
    program = {"authorization": f"Bearer {token}"}
    assert browser().get(f"{V1}/account", headers=program).json()["how"] == "token"
    (account,) = [one for one in administrator.get(f"{V1}/accounts").json()["accounts"] if one["name"] == name]
    path = f"{V1}/accounts/{account['id']}"
    assert administrator.patch(path, json={"disabled": True}).json()["disabled_at"]
    assert engineer.get(f"{V1}/account").status_code == 401 and sign_in(browser(), name).status_code == 401
    assert browser().get(f"{V1}/account", headers=program).status_code == 401
    assert administrator.post(f"{path}/password-link").status_code == 409
    assert administrator.patch(path, json={"disabled": False}).json()["disabled_at"] is None
    assert engineer.get(f"{V1}/account").status_code == 401  # a session that was stolen does not come back
    assert browser().get(f"{V1}/account", headers=program).status_code == 401
    assert sign_in(browser(), name).status_code == 204


def test_a_changed_role_holds_for_the_next_request(person: Person) -> None:
    administrator, engineer = person(Role.ADMINISTRATOR), person(Role.ENGINEER)
    name = name_of(engineer)
    assert engineer.post(f"{V1}/library/plans", json={"plan": plan(), "name": "Mine"}).status_code == 201
    (account,) = [one for one in administrator.get(f"{V1}/accounts").json()["accounts"] if one["name"] == name]
    administrator.patch(f"{V1}/accounts/{account['id']}", json={"role": "viewer"}).raise_for_status()
    refused = engineer.post(f"{V1}/library/plans", json={"plan": plan(), "name": "Mine too"})
    assert refused.status_code == 403 and "needs the role engineer" in refused.json()["detail"]


def test_the_last_administrator_cannot_be_removed(tmp_path: Path) -> None:
    with TestClient(
        create_app(Settings(data=tmp_path, embedded_worker=False, local_sign_in=True)), ADDRESS, client=HERE
    ) as one:
        with unit_of_work(app_of(one).state.sessions) as session:
            last = AccountService(session).add("Ana Ruiz", Role.ADMINISTRATOR, PASSWORD)
            AccountService(session).add("Invited", Role.ADMINISTRATOR)  # without a password yet
        for change in ({"role": "engineer"}, {"disabled": True}):
            answer = one.patch(f"{V1}/accounts/{last.id}", json=change)
            assert answer.status_code == 409 and "last administrator" in answer.json()["detail"]
        assert one.post(f"{V1}/accounts", json={"name": "ANA RUIZ"}).status_code == 409
        assert one.get(f"{V1}/account/tokens").status_code == 409  # local, without an account
        assert one.post(f"{V1}/sign-out").status_code == 204


ROLES = {
    Role.VIEWER: [("GET", "/runs"), ("POST", "/abort")],
    Role.OPERATOR: [("POST", "/queue/hold"), ("POST", "/queue/release"), ("POST", "/runs/none/cancel")],
    Role.ENGINEER: [("POST", "/sweeps"), ("POST", "/diagnoses"), ("POST", "/library/plans"), ("DELETE", "/runs/none")],
    Role.ADMINISTRATOR: [("POST", "/rigs"), ("PUT", "/laboratory"), ("POST", "/webhooks"), ("GET", "/accounts")],
}


@pytest.mark.parametrize("role", list(Role))
def test_a_role_may_do_what_lower_roles_may_and_nothing_else(role: Role, person: Person) -> None:
    one = person(role)
    for needed, requests in ROLES.items():
        for method, path in requests:
            status = one.request(method, f"{V1}{path}", json={} if method != "GET" else None).status_code
            assert (status == 403) is (needed > role), (method, path, status)


def test_an_unknown_name_is_refused_as_a_wrong_password_is(person: Person, browser: Callable[..., TestClient]) -> None:
    name = name_of(person(Role.VIEWER))
    wrong, unknown = sign_in(browser(), name, "a wrong password"), sign_in(browser(), "Nobody", "a wrong password")
    assert wrong.status_code == unknown.status_code == 401 and wrong.content == unknown.content


def test_a_hash_is_computed_for_unknown_names_too(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[str] = []

    class Counting:
        def hash(self, password: str) -> str:
            return "of nobody"

        def verify(self, stored: str, password: str) -> bool:
            seen.append(stored)
            return True

    monkeypatch.setattr(passwords, "HASHER", Counting())
    monkeypatch.setattr(passwords, "_NOBODYS", [])
    assert not passwords.matches(PASSWORD, None) and passwords.matches(PASSWORD, "stored")
    assert seen == ["of nobody", "stored"]


def test_guesses_at_the_same_time_are_as_few_as_one_after_another(
    person: Person, browser: Callable[..., TestClient], monkeypatch: pytest.MonkeyPatch
) -> None:
    name, looked_at = name_of(person(Role.VIEWER)), []
    all_sent = threading.Event()

    def slow(password: str, stored: str | None) -> bool:
        looked_at.append(password)
        all_sent.wait(30)
        return password == PASSWORD

    monkeypatch.setattr(passwords, "matches", slow)
    guesser = browser("198.51.100.1")
    with ThreadPoolExecutor(20) as together:
        sent = [together.submit(sign_in, guesser, name, "a wrong guess") for _ in range(20)]
        until(lambda: sum(one.done() for one in sent), lambda done: done == 15)  # refused before a hash is computed
        all_sent.set()
        assert sorted(one.result().status_code for one in sent) == [401] * 5 + [429] * 15
    assert len(looked_at) == 5 and sign_in(guesser, name).status_code == 429
    owner = browser("192.0.2.1")
    assert [sign_in(owner, name).status_code for _ in range(7)] == [204] * 7  # given back
    present = {"present": "a wrong password", "password": "another password"}
    assert [owner.post(f"{V1}/account/password", json=present).status_code for _ in range(6)] == [422] * 5 + [429]


def test_an_attempt_that_was_not_looked_at_does_not_count() -> None:
    throttle = Throttle()
    for _ in range(40):
        with pytest.raises(Unavailable), throttle.attempt("ana", "192.0.2.1", False):
            raise Unavailable("busy")
    with throttle.attempt("ana", "192.0.2.1", False):
        assert throttle._under_way.total() == 3
    assert not throttle._under_way


def test_names_that_look_like_others_or_like_the_program_are_refused(person: Person) -> None:
    refused = person(Role.ADMINISTRATOR).post(f"{V1}/accounts", json={"name": "Service"})
    assert refused.status_code == 422 and refused.json()["errors"][0]["where"] == "name"
    for name in ("Local  Administrator", "\u200bAna", "\u3164", "\u0410na Ruiz", "Ana\ufe0f", " ", "Wor\nker\x00"):
        with pytest.raises(RthsError, match="name"):
            names.checked(name)
    assert names.checked("Jos\u00e9  \u674e") == "Jos\u00e9 \u674e"
    for name in (
        "Yıldız Öz",
        "Nguyễn Văn Ứng",
        "Kaʻiu Kalā",
        "ラーメン 太郎 Taro",
        "김 Minsu",
        "Αθηνά",
        "Օհան",
        "O'Neil-Smith 2",
    ):
        assert names.checked(name) == name


def test_a_name_that_reads_like_another_or_like_the_program_is_refused(person: Person) -> None:
    administrator = person(Role.ADMINISTRATOR)
    mixed = ("\u0555la Operator", "\u13bela Operator", "\u0410la", "Al\u03bf", "\u2c9fla", "\u10ffla")
    program = ("serv\u0131ce", "SERV\u0130CE", "service.", "s\u00e9rvice", "work-er", "W\u00f8rker", "\uff33ervice")
    for name in (*mixed, *program, "Administrator", "engineer!", "(audit)"):
        refused = administrator.post(f"{V1}/accounts", json={"name": name})
        assert refused.status_code == 422 and refused.json()["errors"][0]["where"] == "name", ascii(name)


def test_the_sign_in_page_says_where_the_first_link_is_as_long_as_there_is_no_account(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data=tmp_path, embedded_worker=False)), ADDRESS, client=HERE) as fresh:
        said = fresh.get("/sign-in").text
        assert "no account yet" in said and "rths account link" in said and "ask an administrator" not in said
        with unit_of_work(app_of(fresh).state.sessions) as session:
            AccountService(session).add("Ana", Role.ADMINISTRATOR, PASSWORD)
        said = fresh.get("/sign-in").text
        assert "no account yet" not in said and "ask an administrator" in said


def test_names_that_differ_in_spaces_are_one_name(person: Person, browser: Callable[..., TestClient]) -> None:
    administrator = person(Role.ADMINISTRATOR, "One  Space\u00a0Only")
    assert name_of(administrator) == "One Space Only"
    assert administrator.post(f"{V1}/accounts", json={"name": "one space   only"}).status_code == 409
    assert sign_in(browser(), " one   space only ").status_code == 204
    assert administrator.post(f"{V1}/accounts", json={"name": "\u041e\u043b\u044c\u0433\u0430 \u674e"}).status_code == 201


def test_the_audit_log_names_the_account_that_a_link_belongs_to(person: Person, browser: Callable[..., TestClient]) -> None:
    administrator = person(Role.ADMINISTRATOR)
    key = administrator.post(f"{V1}/accounts", json={"name": "Real Name"}).json()["path"].partition("#")[2]
    used = browser().post(f"{V1}/sign-in/link", json={"key": key, "password": PASSWORD, "name": "Somebody Else"})
    assert used.status_code == 204 and sign_in(browser(), "REAL name").status_code == 204
    entries = administrator.get(f"{V1}/audit", params={"who": "Real Name"}).json()["entries"]
    assert [(one["action"], one["role"]) for one in entries] == [("sign_in", "viewer"), ("sign-in.link.use_link", "viewer")]


def test_the_page_of_a_link_knows_whether_a_password_is_replaced(person: Person, browser: Callable[..., TestClient]) -> None:
    administrator = person(Role.ADMINISTRATOR)
    made = administrator.post(f"{V1}/accounts", json={"name": "Quite New"}).json()
    for replaces in (False, True):
        key = made["path"].partition("#")[2]
        assert browser().post(f"{V1}/sign-in/link/read", json={"key": key}).json()["replaces"] is replaces
        assert browser().post(f"{V1}/sign-in/link", json={"key": key, "password": PASSWORD}).status_code == 204
        made = administrator.post(f"{V1}/accounts/{made['account']['id']}/password-link").json()


def test_guessing_is_slowed_down_and_the_owner_still_signs_in(person: Person, browser: Callable[..., TestClient]) -> None:
    name = name_of(person(Role.VIEWER))  # from 192.0.2.1
    for _ in range(5):
        assert sign_in(browser("198.51.100.1"), name, "a wrong guess").status_code == 401
    slowed = sign_in(browser("198.51.100.1"), name, "a wrong guess")
    assert slowed.status_code == 429 and 0 < int(slowed.headers["retry-after"]) <= 60
    for guesser in range(2, 5):
        for _ in range(5):
            sign_in(browser(f"198.51.100.{guesser}"), name, "a wrong guess")
    assert sign_in(browser("198.51.100.9"), name).status_code == 429  # the account is under attack
    assert sign_in(browser("192.0.2.1"), name).status_code == 204  # its owner, from a known address
