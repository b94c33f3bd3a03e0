"""Every answer restricts what a browser does with it, and requests under a foreign host name are refused."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app import config, headers
from app.config import Settings
from app.main import create_app
from tests.app.conftest import HERE
from tests.app.test_head import addresses
from tests.app.test_openapi import DOCUMENT

REFUSED: tuple[tuple[str, str, dict[str, Any], int], ...] = (
    ("GET", "/api/v1/nowhere", {}, 404),
    ("GET", "/nowhere", {}, 404),
    ("GET", "/static/nowhere.js", {}, 404),
    ("PUT", "/api/v1/runs", {}, 405),
    ("POST", "/api/v1/runs", {"content": b"{"}, 415),
    ("POST", "/api/v1/runs", {"json": {}}, 422),
    ("POST", "/api/v1/runs", {"json": {}, "headers": {"content-length": str(10**9)}}, 413),
    ("POST", "/api/v1/abort", {"headers": {"origin": "http://elsewhere.example"}}, 403),
    ("GET", "/api/v1/runs", {"headers": {"host": "elsewhere.example"}}, 421),
    ("GET", "/api/v1/runs?q=%00", {}, 400),
)


def restricts(answer: Any, told: str) -> None:
    policy = answer.headers[headers.POLICY]
    assert "default-src 'none'" in policy and "frame-ancestors 'none'" in policy, told
    scripts = re.search(r"script-src ([^;]*)", policy)
    assert not scripts or "unsafe" not in scripts[1], told
    assert answer.headers["x-content-type-options"] == "nosniff", told
    assert answer.headers["referrer-policy"] == "same-origin", told


def test_every_answer_has_the_headers_that_restrict_a_browser(earlier: TestClient) -> None:
    for path in addresses(earlier):
        restricts(earlier.get(path, follow_redirects=False), path)
    for path in ("/static/css/app.css", "/static/js/abort.js", "/help/queue"):
        restricts(earlier.get(path), path)
    for method, path, more, status in REFUSED:
        answer = earlier.request(method, path, **more)
        assert answer.status_code == status, answer.text
        restricts(answer, f"{method} {path}")


def test_a_failure_of_the_service_has_them_too(client: TestClient) -> None:
    del client.app.state.sessions  # type: ignore[attr-defined]
    answer = client.get("/api/v1/runs")
    assert answer.status_code == 500
    restricts(answer, "500")


def test_the_scripts_inside_a_page_are_named_by_their_hash(earlier: TestClient) -> None:
    run = next(one for one in earlier.get("/api/v1/runs").json()["runs"] if one["recording"])
    for path in ("/api/docs", f"/api/v1/runs/{run['id']}/report.html?interactive=true"):
        answer = earlier.get(path)
        inside = re.findall(r"<script>", answer.text)
        assert answer.headers[headers.POLICY].count("'sha256-") == len(inside) > 0
    light = earlier.get(f"/api/v1/runs/{run['id']}/report.html").headers[headers.POLICY]
    assert "script-src 'none'" in light and "sandbox" in light


@pytest.mark.parametrize("host", ["elsewhere.example", "127.0.0.1.elsewhere.example", "[::1", "", "elsewhere.example:8000"])
@pytest.mark.parametrize("path", ["/", "/api/v1/runs", "/openapi.json", "/static/css/app.css"])
def test_nothing_is_read_under_a_foreign_host_name(serving: TestClient, path: str, host: str) -> None:
    """A page of another site may give its name the address of this machine: the browser then sends that name as Host."""
    answer = serving.get(path, headers={"host": host})
    assert answer.status_code == 421
    assert "RTHS_HOSTS" in answer.json()["detail"]


@pytest.mark.parametrize("host", ["127.0.0.1:8000", "localhost", "LOCALHOST:8000", "[::1]:8000"])
def test_the_names_of_this_machine_are_known_in_any_case(serving: TestClient, host: str) -> None:
    assert serving.get("/api/v1/runs", headers={"host": host}).status_code == 200


def test_a_monitor_asks_for_the_health_under_any_host_name(client: TestClient) -> None:
    assert client.get("/healthz", headers={"host": "10.0.0.4:8000"}).status_code == 503  # no worker is alive


def test_a_service_on_a_network_knows_the_hosts_of_its_settings(settings: Settings) -> None:
    settings_of_lab = replace(settings, host="0.0.0.0", hosts=("Lab.example",))
    with TestClient(create_app(settings_of_lab), "http://lab.example", client=HERE) as one:
        assert one.get("/api/v1/runs").status_code == 200
        assert one.get("/api/v1/runs", headers={"host": "elsewhere.example"}).status_code == 421


def test_a_service_on_a_network_knows_its_own_names_and_addresses_by_itself(
    settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(config, "own_names", lambda: frozenset({"control-room"}))
    with TestClient(create_app(replace(settings, host="0.0.0.0")), "http://control-room", client=HERE) as one:
        for host, status in {
            "control-room:8000": 200,
            "172.17.0.2:8000": 200,
            "[fe80::1]:8000": 200,
            "elsewhere.example": 421,
            "172.17.0.2.elsewhere.example": 421,
        }.items():
            assert one.get("/api/v1/runs", headers={"host": host}).status_code == status, host
        refused = one.get("/api/v1/runs", headers={"host": "elsewhere.example"}).json()["detail"]
        assert "control-room" in refused and "RTHS_HOSTS" in refused
        for probe in ("/livez", "/healthz", "/readyz"):
            assert one.get(probe, headers={"host": "10.0.0.4"}).status_code in {200, 503}


def test_a_websocket_of_a_page_is_checked_and_that_of_a_program_is_not(client: TestClient) -> None:
    path = "/api/v1/runs/nothing/live"
    for sent in ({"host": "elsewhere.example", "origin": "http://elsewhere.example"}, {"origin": "http://elsewhere.example"}):
        with pytest.raises(WebSocketDisconnect) as refused, client.websocket_connect(path, headers=sent):
            pass
        assert refused.value.code == 4403
    with client.websocket_connect(path, headers={"host": "10.0.0.4:8000"}) as socket:
        assert socket.receive()["code"] == 4404  # there is no such run


def test_every_route_says_that_a_foreign_host_name_is_refused() -> None:
    for path, item in DOCUMENT["paths"].items():
        for operation in item.values():
            assert ("421" in operation["responses"]) is (path not in ("/livez", "/healthz", "/readyz")), path
