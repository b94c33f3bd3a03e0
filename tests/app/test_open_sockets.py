"""Open websockets close once the credential of the person ends, whatever ended it and wherever."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi import WebSocket
from fastapi.testclient import TestClient
from starlette.testclient import WebSocketTestSession

from app.access import Access, Role, Scope, SignedIn, allowed
from app.accounts.repository import AccountRows
from app.accounts.service import AccountService
from app.db import unit_of_work
from app.models import AccountSession, ApiToken
from app.open_sockets import OpenSocket, OpenSockets
from tests.app import people
from tests.app.conftest import ADDRESS, app_of, plan
from tests.app.people import COOKIE, PASSWORD, V1, Person, browser, person, sign_in
from tests.coroutines import finished

__all__ = ["browser", "person"]  # fixtures

PATIENCE_S = 30.0
NEW = "another horse battery"


@allowed(Role.ENGINEER)
async def _of_engineers(socket: WebSocket) -> None:
    await socket.accept()
    while True:
        await socket.receive_text()


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A control room with accounts, and a websocket that engineers may open."""
    made = people.lab.__wrapped__(tmp_path_factory)  # type: ignore[attr-defined]
    one = next(made)
    app_of(one).add_api_websocket_route(f"{V1}/of-engineers", _of_engineers)
    yield one
    made.close()


@pytest.fixture(scope="module")
def run(lab: TestClient) -> str:
    """The id of a queued run, which no worker takes: a viewer of it waits."""
    with unit_of_work(app_of(lab).state.sessions) as session:
        AccountService(session).add("Owner of the run", Role.ENGINEER, PASSWORD)
    one = TestClient(app_of(lab), ADDRESS, client=("192.0.2.9", 1))
    assert sign_in(one, "Owner of the run").status_code == 204
    found: str = one.post(f"{V1}/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    return found


def cookie(one: TestClient) -> dict[str, str]:
    return {"cookie": f"{COOKIE}={one.cookies[COOKIE]}"}


@contextmanager
def watching(one: TestClient, run: str, headers: dict[str, str] | None = None) -> Iterator[WebSocketTestSession]:
    with one.websocket_connect(f"{V1}/runs/{run}/live", headers=headers or cookie(one)) as socket:
        assert socket.receive()["type"] == "websocket.send"
        yield socket


def closed(socket: WebSocketTestSession) -> tuple[int, str]:
    """Code and reason of the close, after what was sent before it."""
    until = time.monotonic() + PATIENCE_S
    while time.monotonic() < until:
        got = socket.receive()
        if got["type"] == "websocket.close":
            return got["code"], got["reason"]
    raise AssertionError("the websocket is still open")


def account_id(one: TestClient, name: str) -> str:
    found: str = next(account["id"] for account in one.get(f"{V1}/accounts").json()["accounts"] if account["name"] == name)
    return found


def _sign_out(mine: TestClient, _: TestClient) -> Any:
    return mine.post(f"{V1}/sign-out")


def _end_session(_: TestClient, elsewhere: TestClient) -> Any:
    other = next(one for one in elsewhere.get(f"{V1}/account/sessions").json()["sessions"] if not one["present"])
    return elsewhere.delete(f"{V1}/account/sessions/{other['id']}")


def _end_others(_: TestClient, elsewhere: TestClient) -> Any:
    return elsewhere.delete(f"{V1}/account/sessions")


def _new_password(_: TestClient, elsewhere: TestClient) -> Any:
    return elsewhere.post(f"{V1}/account/password", json={"present": PASSWORD, "password": NEW})


@pytest.mark.parametrize("end", [_sign_out, _end_session, _end_others, _new_password])
def test_a_live_view_closes_with_its_session_and_no_other(
    end: Callable[[TestClient, TestClient], Any], person: Person, browser: Callable[..., TestClient], run: str
) -> None:
    mine, elsewhere = person(Role.VIEWER, end.__name__), browser("192.0.2.2")
    assert sign_in(elsewhere, end.__name__).status_code == 204
    with watching(mine, run) as ended, watching(elsewhere, run) as stays:
        assert end(mine, elsewhere).status_code == 204
        assert closed(ended) == (4403, "your session has ended")
        assert stays.receive()["type"] == "websocket.send"


def test_a_live_view_closes_when_the_account_is_disabled_or_its_password_is_chosen_by_a_link(
    person: Person, browser: Callable[..., TestClient], run: str
) -> None:
    administrator, viewer = person(Role.ADMINISTRATOR), person(Role.VIEWER, "Watches on")
    mine = account_id(administrator, "Watches on")
    with watching(viewer, run) as socket:
        path = administrator.post(f"{V1}/accounts/{mine}/password-link").json()["path"]
        used = browser().post(f"{V1}/sign-in/link", json={"key": path.partition("#")[2], "password": NEW})
        assert used.status_code == 204
        assert closed(socket) == (4403, "your session has ended")
    assert sign_in(viewer, "Watches on", NEW).status_code == 204
    with watching(viewer, run) as socket:
        assert administrator.patch(f"{V1}/accounts/{mine}", json={"disabled": True}).status_code == 200
        assert closed(socket) == (4403, "the account is disabled")


def test_a_live_view_closes_when_its_token_is_revoked_or_expires(person: Person, run: str, lab: TestClient) -> None:
    one = person(Role.VIEWER)
    tokens = [one.post(f"{V1}/account/tokens", json={"name": name}).json() for name in ("first", "second")]
    first, second = ({"authorization": f"Bearer {token['token']}"} for token in tokens)
    with watching(one, run, first) as revoked, watching(one, run, second) as expired:
        assert one.delete(f"{V1}/account/tokens/{tokens[0]['id']}").status_code == 204
        assert closed(revoked) == (4403, "the API token has expired or was revoked")
        with unit_of_work(app_of(lab).state.sessions) as session:
            past = datetime.now(UTC) - timedelta(seconds=1)
            session.execute(sa.update(ApiToken).where(ApiToken.id == tokens[1]["id"]).values(expires_at=past))
        app_of(lab).state.credentials.look_again()  # as every 15 s
        assert closed(expired)[0] == 4403


def test_a_websocket_closes_when_the_role_falls_below_what_it_needs(person: Person, run: str) -> None:
    administrator, engineer = person(Role.ADMINISTRATOR), person(Role.ENGINEER, "Falls")
    with (
        watching(engineer, run) as viewed,
        engineer.websocket_connect(f"{V1}/of-engineers", headers=cookie(engineer)) as socket,
    ):
        changed = administrator.patch(f"{V1}/accounts/{account_id(administrator, 'Falls')}", json={"role": "operator"})
        assert changed.status_code == 200
        assert closed(socket) == (4403, "your role is now operator; this view needs engineer")
        assert viewed.receive()["type"] == "websocket.send"


def test_an_ending_in_another_process_closes_too_with_one_query_for_all_viewers(
    person: Person, run: str, lab: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []
    with_ids = AccountRows.with_ids

    def counted(self: AccountRows, table: Any, ids: Any) -> Any:
        asked.append(list(ids))
        return with_ids(self, table, ids)

    monkeypatch.setattr(AccountRows, "with_ids", counted)
    one, two = person(Role.VIEWER, "One of a crowd"), person(Role.VIEWER, "Two of a crowd")
    with watching(one, run) as first, watching(one, run) as second, watching(two, run) as third:
        with unit_of_work(app_of(lab).state.sessions) as session:
            session.execute(sa.update(AccountSession).values(ended_at=datetime.now(UTC)))
        app_of(lab).state.credentials.look_again()
        assert {closed(socket) for socket in (first, second, third)} == {(4403, "your session has ended")}
        assert [len(ids) for ids in asked] == [2]
    log = app_of(lab).state.audit
    log.waiting.join()
    assert app_of(lab).state.sockets.credentials("session") == []


def test_what_expires_closes_without_a_database_and_an_application_that_only_sends_is_stopped() -> None:
    sent: list[dict[str, Any]] = []
    sockets = OpenSockets()
    expired = SignedIn("Ana", Role.VIEWER, "token", "1", "2", frozenset(Scope), datetime.now(UTC))

    async def sends(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "websocket.accept"})
        sockets.expire()
        for _ in range(1000):
            await send({"type": "websocket.send", "text": "x"})
            await receive()

    async def received() -> dict[str, Any]:
        return {"type": "websocket.receive", "text": ""}

    async def kept(message: Any) -> None:
        sent.append(message)

    async def serve() -> None:
        access = Access(Role.VIEWER, frozenset(Scope))
        with sockets.held(OpenSocket(expired, access, {"type": "websocket"}, received, kept)) as one:
            await one.serve(sends)

    finished(serve())
    assert [message["type"] for message in sent][-1] == "websocket.close" and sent[-1]["code"] == 4403
    assert len(sent) < 10
