"""API tokens, credentials in memory, the names that are stored, and attempts to slip past the gate."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient
from sqlalchemy.exc import OperationalError
from starlette.websockets import WebSocketDisconnect

from app.access import Role, Scope
from app.accounts import credentials as module
from app.db import unit_of_work
from app.models import AccountSession, ApiToken
from tests.app.conftest import ADDRESS, app_of, plan
from tests.app.people import COOKIE, V1, Person, browser, lab, name_of, person

__all__ = ["browser", "lab", "person"]  # fixtures

Browser = Callable[..., TestClient]


def token_of(one: TestClient, *scopes: Scope, **more: Any) -> str:
    made = one.post(f"{V1}/account/tokens", json={"name": "script", "scopes": scopes or [Scope.READ], **more})
    found: str = made.raise_for_status().json()["token"]
    return found


def program(browser: Browser, token: str) -> TestClient:
    one = browser()
    one.headers["authorization"] = f"Bearer {token}"
    return one


def live(one: TestClient, cookie: str) -> Any:
    """The websocket of viewers, with a cookie: the test client sends none by itself."""
    return one.websocket_connect(f"{V1}/runs/none/live", headers={"cookie": f"{COOKIE}={cookie}"})


def test_a_token_does_what_its_scopes_say_within_the_role(person: Person, browser: Browser, lab: TestClient) -> None:
    engineer = person(Role.ENGINEER)
    reader = program(browser, token_of(engineer))
    assert reader.get(f"{V1}/runs").status_code == 200
    refused = reader.post(f"{V1}/runs", json={"plan": plan()})
    assert refused.status_code == 403 and "operate or submit" in refused.json()["detail"]
    submitter = program(browser, token_of(engineer, Scope.SUBMIT))
    assert submitter.post(f"{V1}/runs", json={"plan": plan()}).status_code == 201
    assert submitter.get(f"{V1}/runs").status_code == 403
    assert submitter.post(f"{V1}/abort").status_code == 200  # with every token
    beyond = engineer.post(f"{V1}/account/tokens", json={"name": "x", "scopes": ["administer"]})
    assert beyond.status_code == 422 and "needs the role administrator" in beyond.json()["detail"]
    administers = program(browser, token_of(person(Role.ADMINISTRATOR), *Scope))
    for path in ("/account/tokens", "/account/sessions", "/accounts", "/accounts/none/tokens"):
        for one in (reader, administers):
            assert one.get(f"{V1}{path}").status_code == 403  # a token makes no tokens, and manages no accounts
    with unit_of_work(app_of(lab).state.sessions) as session:
        stored = session.scalars(sa.select(ApiToken)).all()
        assert all(len(row.key_sha256) == 64 and "rths_" not in str(vars(row)) for row in stored)


def test_a_token_ends_when_it_is_revoked_or_expires(
    person: Person, browser: Browser, lab: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = person(Role.VIEWER)
    first, second = program(browser, token_of(one)), program(browser, token_of(one))
    assert first.get(f"{V1}/account").status_code == second.get(f"{V1}/account").status_code == 200
    newest, oldest = one.get(f"{V1}/account/tokens").json()["tokens"]
    assert newest["used_at"] and "token" not in newest
    assert one.delete(f"{V1}/account/tokens/{oldest['id']}").status_code == 204
    assert first.get(f"{V1}/account").status_code == 401 and second.get(f"{V1}/account").status_code == 200
    with unit_of_work(app_of(lab).state.sessions) as session:
        session.execute(sa.update(ApiToken).values(expires_at=ApiToken.created_at))
    app_of(lab).state.credentials.renew()
    assert second.get(f"{V1}/account").status_code == 401
    assert one.post(f"{V1}/account/tokens", json={"name": "x", "days": 367}).status_code == 422


def test_a_key_is_taken_only_where_it_belongs(person: Person, browser: Browser) -> None:
    one = person(Role.VIEWER)
    token, cookie = token_of(one), one.cookies[COOKIE]
    assert browser().get(f"{V1}/account?token={token}&access_token={token}").status_code == 401
    assert program(browser, cookie).get(f"{V1}/account").status_code == 401  # a session is no token
    for headers in ({"authorization": token}, {"authorization": f"Basic {token}"}, {"x-api-key": token}):
        assert browser().get(f"{V1}/account", headers=headers).status_code == 401
    swapped = browser()
    swapped.cookies.set(COOKIE, token, "127.0.0.1")
    assert swapped.get(f"{V1}/account").status_code == 401  # a token is no session
    one.headers["authorization"] = "Bearer wrong"
    assert one.get(f"{V1}/account").status_code == 401  # a wrong token is not helped by a cookie


def test_a_session_ends_when_it_is_not_used(person: Person, lab: TestClient) -> None:
    one = person(Role.VIEWER)
    with unit_of_work(app_of(lab).state.sessions) as session:
        for row in session.scalars(sa.select(AccountSession)):
            row.seen_at -= module.IDLE
    app_of(lab).state.credentials.renew()
    assert one.get(f"{V1}/account").status_code == 401


def test_abort_and_live_views_need_no_database(person: Person, lab: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    one = person(Role.VIEWER)
    credentials = app_of(lab).state.credentials
    assert one.get(f"{V1}/account").status_code == 200

    def silent(*_: object) -> None:
        raise OperationalError("select", {}, Exception("the database is locked"))

    monkeypatch.setattr(credentials, "_renew", silent)
    monkeypatch.setattr(module, "FRESH_S", 0.0)
    answer = one.get(f"{V1}/account")
    assert answer.status_code == 503 and answer.headers["retry-after"] == "5"
    assert one.post(f"{V1}/abort").status_code == 200
    with live(one, one.cookies[COOKIE]) as socket, pytest.raises(WebSocketDisconnect) as ended:
        socket.receive_text()
    assert ended.value.code == 4404  # past the gate: there is no such run
    monkeypatch.setattr(module, "REMEMBERED_S", 0.0)
    assert one.post(f"{V1}/abort").status_code == 503


def test_memory_is_bounded(person: Person, lab: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST", 2)
    people = [person(Role.VIEWER, f"Person {number} of a crowd") for number in range(4)]
    assert all(one.get(f"{V1}/account").status_code == 200 for one in people)
    assert len(app_of(lab).state.credentials._known) == 2


@pytest.mark.parametrize("cookie", ["", "x", "a" * 5000, '"; --', "%00"])
def test_a_websocket_without_credentials_is_refused(browser: Browser, cookie: str) -> None:
    one = browser()
    one.cookies.set(COOKIE, cookie, "127.0.0.1")
    with pytest.raises(WebSocketDisconnect) as refused, live(one, cookie):
        pass
    assert refused.value.code == 4403
    assert one.get(f"{V1}/runs").status_code == 401


def test_the_worker_token_opens_nothing_but_the_address_of_workers(lab: TestClient, browser: Browser, person: Person) -> None:
    worker = program(browser, app_of(lab).state.settings.worker_token)
    assert worker.get(f"{V1}/runs").status_code == 401
    with worker.websocket_connect(f"{V1}/worker") as socket:
        socket.close()
    administrator = person(Role.ADMINISTRATOR)
    cookie = {"cookie": f"{COOKIE}={administrator.cookies[COOKIE]}"}
    with (
        administrator.websocket_connect(f"{V1}/worker", headers=cookie) as socket,
        pytest.raises(WebSocketDisconnect) as refused,
    ):
        socket.receive_text()
    assert refused.value.code == 4403


def test_another_site_cannot_use_the_cookie(person: Person) -> None:
    one = person(Role.ADMINISTRATOR)
    foreign = {"origin": "http://elsewhere.example"}
    assert one.post(f"{V1}/abort", headers=foreign).status_code == 403
    assert one.post(f"{V1}/sign-in", json={"name": "x", "password": "x"}, headers=foreign).status_code == 403
    assert one.post("/sign-out", headers=foreign).status_code == 403


def test_what_is_stored_carries_the_name_of_the_account(person: Person) -> None:
    one = person(Role.ENGINEER)
    name, typed = name_of(one), "Somebody Else"
    run = one.post(f"{V1}/runs", json={"plan": plan(), "submitted_by": typed}).json()["runs"][0]
    assert run["submitted_by"] == name
    assert one.post(f"{V1}/runs", json={"plan": plan()}).json()["runs"][0]["submitted_by"] == name
    kept = one.post(f"{V1}/library/plans", json={"plan": plan(), "name": f"Plan of {name}", "saved_by": typed}).json()
    assert one.get(f"{V1}/library/plans/{kept['id']}").json()["history"][0]["saved_by"] == name
    for body in ({"by": typed, "reason": "oil"}, {"reason": "oil"}):
        assert one.post(f"{V1}/queue/hold", json=body).json()["held_by"] == name
    assert one.post(f"{V1}/queue/release").status_code == 200
    cancelled = one.post(f"{V1}/runs/{run['id']}/cancel")  # without a body
    assert name in cancelled.json()["reason"]


def test_an_operator_queues_plans_of_the_library_and_no_others(person: Person, browser: Browser) -> None:
    engineer, operator = person(Role.ENGINEER), person(Role.OPERATOR)
    kept = engineer.post(f"{V1}/library/plans", json={"plan": plan(), "name": "Checked plan"}).json()
    library = {"id": kept["id"], "version": 1}
    assert operator.post(f"{V1}/runs", json={"plan": plan(), "library": library}).status_code == 201
    changed = operator.post(f"{V1}/runs", json={"plan": plan(duration=3.0), "library": library})
    assert changed.status_code == 403 and "as they are" in changed.json()["detail"]
    for different in ({"pace": {"kind": "real_time", "factor": 1.0}}, {"name": "harmless"}, {"notes": "checked"}):
        for body in ({"plan": plan(**different)}, {"plans": [plan(), plan(**different)]}):  # no digest sees these
            refused = operator.post(f"{V1}/runs", json={**body, "library": library})
            assert refused.status_code == 403 and f", in {next(iter(different))}." in refused.json()["detail"]
    assert operator.post(f"{V1}/runs", json={"plan": plan()}).status_code == 403
    refused = operator.post(f"{V1}/account/tokens", json={"name": "x", "scopes": ["submit"]})
    assert refused.status_code == 422 and "scope operate queues plans of the library" in refused.json()["detail"]
    for who in (operator, engineer):  # a token with the scope operate does as an operator does
        queues = program(browser, token_of(who, Scope.OPERATE))
        assert queues.post(f"{V1}/runs", json={"plan": plan(), "library": library}).status_code == 201
        assert queues.post(f"{V1}/runs", json={"plan": plan(duration=3.0), "library": library}).status_code == 403
        assert queues.post(f"{V1}/runs", json={"plan": plan(duration=3.0)}).status_code == 403
    durations = {run["duration_s"] for run in operator.get(f"{V1}/runs?limit=500").json()["runs"]}
    assert durations == {2.0}  # nothing of what was refused is stored
    assert engineer.post(f"{V1}/library/plans/{kept['id']}/archive").status_code == 200
    archived = operator.post(f"{V1}/runs", json={"plan": plan(), "library": library})
    assert archived.status_code == 403 and "Checked plan, version 1, is archived" in archived.json()["detail"]
    assert engineer.post(f"{V1}/runs", json={"plan": plan(), "library": library}).status_code == 201


@pytest.mark.parametrize("path", ["/sign-in", "/sign-in/link", "/sign-in?to=//elsewhere.example"])
def test_the_doors_are_open_and_show_nothing(browser: Browser, path: str) -> None:
    page = browser().get(path)
    assert page.status_code == 200 and "elsewhere" not in page.text and "/queue" not in page.text
    assert "script-src 'self'" in page.headers["content-security-policy"]


def test_every_page_says_who_is_signed_in(person: Person, browser: Browser, client: TestClient) -> None:
    one = person(Role.VIEWER)
    page = one.get("/account", headers={"accept": "text/html"})
    assert f"Account of {name_of(one)}" in page.text and "No accounts" not in page.text
    assert one.get("/settings").text.count("account-form") == 0
    assert "No accounts: everyone on this computer" in client.get("/queue").text
    out = one.post("/sign-out", follow_redirects=False)
    assert (out.status_code, out.headers["location"]) == (303, "/sign-in") and one.get(f"{V1}/account").status_code == 401
    left = TestClient(app_of(client), ADDRESS, client=("192.0.2.1", 1), follow_redirects=False)
    assert left.get("/account", headers={"accept": "text/html"}).headers["location"] == "/sign-in?to=%2Faccount"
