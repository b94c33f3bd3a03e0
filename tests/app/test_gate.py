"""Every route, websocket and mount says who may use it, and none that does not say so can be used."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import pytest
from fastapi import APIRouter, FastAPI, WebSocket
from fastapi.testclient import TestClient
from starlette.applications import Starlette
from starlette.websockets import WebSocketDisconnect

from app.access import ANYONE, LOCAL, WORKER, Role, Who, allowed
from app.config import Settings
from app.gate import Place, places
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, app_of

PAGE = {"accept": "text/html"}


@pytest.fixture
def made(settings: Settings) -> FastAPI:
    """An application that no request has reached yet, so that a test can add routes."""
    return create_app(settings)


@pytest.fixture(scope="module")
def stranger(earlier: TestClient) -> TestClient:
    """A client on another computer, without credentials."""
    return TestClient(app_of(earlier), ADDRESS, client=("192.0.2.7", 50_000), follow_redirects=False)


def address(place: Place) -> str:
    return re.sub(r"\{[^}]*\}", "1", place.path)


def every(app: FastAPI) -> Iterator[tuple[str, str, Place]]:
    for place in places(app):
        for method in sorted(place.methods) or ["GET"]:
            yield method, address(place), place


def test_every_route_websocket_and_mount_is_declared(made: FastAPI) -> None:
    found = places(made)
    assert [place.path for place in found if place.access is None] == []
    assert {place.kind for place in found} == {"http", "websocket", ""} and len(found) > 150


def test_only_a_few_addresses_are_open(made: FastAPI) -> None:
    open_ones = {place.path for place in places(made) if place.access and place.access.who is ANYONE}
    signing_in = {"/api/v1/sign-in", "/api/v1/sign-in/link", "/api/v1/sign-in/link/read", "/sign-in", "/sign-in/link"}
    assert open_ones == {"/livez", "/healthz", "/readyz", "/static/{path:path}"} | signing_in
    assert {place.path for place in places(made) if place.access and place.access.who is WORKER} == {"/api/v1/worker"}


def test_a_stranger_gets_nothing_from_any_route(stranger: TestClient) -> None:
    for method, path, place in every(app_of(stranger)):
        if place.kind == "http" and place.access and place.access.who is not ANYONE:
            answer = stranger.request(method, path)
            assert answer.status_code == 401, (method, path)
            assert answer.headers["www-authenticate"] == "Bearer"
            if method != "HEAD":
                assert answer.json()["status"] == 401 and "/sign-in" in answer.json()["detail"]
        elif place.kind == "websocket":
            with pytest.raises(WebSocketDisconnect) as refused, stranger.websocket_connect(path) as socket:
                socket.receive_text()
            assert refused.value.code == 4403


def test_a_page_leads_a_stranger_to_the_sign_in_page_and_back(stranger: TestClient) -> None:
    answer = stranger.get("/runs?q=a b&page=2", headers=PAGE)
    assert (answer.status_code, answer.headers["location"]) == (303, "/sign-in?to=%2Fruns%3Fq%3Da%2520b%26page%3D2")
    assert stranger.get("/lab", headers=PAGE | {"hx-request": "true"}).status_code == 401  # a part of a page
    assert stranger.get("/api/docs", headers=PAGE).headers["location"] == "/sign-in?to=%2Fapi%2Fdocs"
    assert stranger.head("/runs", headers=PAGE).headers["location"] == "/sign-in?to=%2Fruns"
    assert stranger.post("/sign-out", headers=PAGE).headers["location"] == "/sign-in"  # nothing to come back to
    assert stranger.get("/runs", headers={"accept": "application/json, text/html;q=0.5"}).status_code == 401


@pytest.mark.parametrize(
    ("method", "path", "status"),
    [
        ("HEAD", "/api/v1/runs", 401),
        ("OPTIONS", "/api/v1/runs", 401),
        ("BREW", "/api/v1/runs", 401),
        ("BREW", "/static/favicon.svg", 405),
        ("POST", "/healthz", 401),
        ("GET", "/API/V1/runs", 401),
        ("GET", "/api/v1/runs/", 401),
        ("GET", "//api/v1/runs", 401),
        ("GET", "/api//v1/runs", 401),
        ("GET", "/static/../api/v1/runs", 401),
        ("GET", "/static/%2e%2e/api/v1/runs", 404),
        ("GET", "/healthz/../api/v1/runs", 401),
        ("GET", "/healthz/", 401),
        ("GET", "/openapi.json", 401),
        ("GET", "/api/docs", 401),
        ("GET", "/api/v1/nowhere", 401),
        ("GET", "/api/v1/runs?token=secret&authorization=Bearer", 401),
    ],
)
def test_no_spelling_of_an_address_passes_the_gate(stranger: TestClient, method: str, path: str, status: int) -> None:
    assert stranger.request(method, path).status_code == status


@pytest.mark.parametrize("name", ["forwarded", "x-forwarded-for", "x-real-ip"])
def test_a_proxy_on_this_computer_does_not_make_strangers_local(earlier: TestClient, name: str) -> None:
    assert earlier.get("/api/v1/runs").status_code == 200
    assert earlier.get("/api/v1/runs", headers={name: "127.0.0.1"}).status_code == 401


@pytest.mark.parametrize("headers", [{"x-forwarded-user": "admin"}, {"host": "localhost"}, {"authorization": "Basic YTpi"}])
def test_no_header_makes_a_stranger_local(stranger: TestClient, headers: dict[str, str]) -> None:
    assert stranger.get("/api/v1/runs", headers=headers).status_code == 401


def test_without_local_sign_in_this_computer_is_a_stranger_too(settings: Settings) -> None:
    with TestClient(create_app(replace(settings, local_sign_in=False)), ADDRESS, client=HERE) as client:
        assert client.get("/api/v1/runs").status_code == 401
        assert client.get("/healthz").status_code != 401 and client.get("/static/favicon.svg").status_code == 200


def test_what_does_not_say_who_may_use_it_is_refused(made: FastAPI) -> None:
    router = APIRouter()

    @router.get("/api/v1/made-up")
    def undeclared() -> None:
        raise AssertionError("the gate let a request pass")

    @router.websocket("/made-up")
    async def undeclared_socket(socket: WebSocket) -> None:
        raise AssertionError("the gate let a websocket pass")

    made.include_router(router)
    made.mount("/api/made-up-files", Starlette())
    client = TestClient(made, ADDRESS, client=HERE)
    answer = client.get("/api/v1/made-up")
    assert answer.status_code == 403 and "does not declare" in answer.json()["detail"]
    assert client.get("/api/made-up-files/x").status_code == 403
    with pytest.raises(WebSocketDisconnect), client.websocket_connect("/made-up"):
        pass
    assert {place.path for place in places(made) if place.access is None} == {
        "/api/v1/made-up",
        "/made-up",
        "/api/made-up-files/{path:path}",
    }


def test_a_route_added_after_the_first_request_is_out_of_reach(made: FastAPI) -> None:
    client = TestClient(made, ADDRESS, client=HERE)
    assert client.get("/api/v1/late").status_code == 404
    made.add_api_route("/api/v1/late", lambda: "passed")
    assert client.get("/api/v1/late").status_code == 404


def test_an_endpoint_knows_the_person_and_a_lower_role_is_refused(made: FastAPI, monkeypatch: pytest.MonkeyPatch) -> None:
    @made.get("/api/v1/me")
    @allowed(Role.OPERATOR)
    def me(who: Who) -> list[str]:
        return [who.name, who.role.name, who.how]

    client = TestClient(made, ADDRESS, client=HERE)
    assert client.get("/api/v1/me").json() == ["local administrator", "ADMINISTRATOR", "local"]
    monkeypatch.setattr("app.gate.LOCAL", replace(LOCAL, role=Role.VIEWER))
    answer = client.get("/api/v1/me")
    assert answer.status_code == 403 and "needs the role operator" in answer.json()["detail"]


def test_a_body_is_not_read_before_the_gate_has_decided(made: FastAPI) -> None:
    def body() -> Iterator[bytes]:
        raise AssertionError("the body was read")
        yield b""

    client = TestClient(made, ADDRESS, client=("192.0.2.7", 1))
    assert client.post("/api/v1/recordings/files", content=body()).status_code == 401
