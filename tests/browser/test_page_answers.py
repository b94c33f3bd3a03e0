"""What pages answer before any browser sees them: errors as pages, and headers that keep them to this service's own parts."""

from __future__ import annotations

import html
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from sqlalchemy.exc import OperationalError

from app import pages
from app.access import LOCAL, Role
from app.config import Settings
from app.main import create_app
from app.pages import rendering
from app.problems import MEDIA_TYPE, TITLES, Conflict
from tests.app.conftest import ADDRESS, HERE

BROWSER = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8"


def _pages_alone(data: Path) -> FastAPI:
    app = FastAPI()
    app.state.settings = Settings(data)
    app.include_router(pages.router)
    return app


def _broken(*_: object) -> None:
    raise RuntimeError("the disk is gone")


def _silent(*_: object) -> None:
    raise OperationalError("select 1", None, Exception("no connection"))


def _contested(*_: object) -> None:
    raise Conflict("The run is being changed.")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> FastAPI:
    return create_app(Settings(tmp_path_factory.mktemp("whole"), embedded_worker=False, local_sign_in=True))


def _asked(app: FastAPI, method: str, path: str, accept: str, **more: Any) -> httpx.Response:
    client = TestClient(app, ADDRESS, client=HERE, raise_server_exceptions=False)
    answer: httpx.Response = client.request(method, path, headers={"accept": accept, **more.get("headers", {})})
    return answer


@pytest.mark.parametrize(
    ("method", "path", "status", "more"),
    [
        ("GET", "/nowhere/at-all", 404, {}),
        ("GET", "/api/v1/nowhere", 404, {}),
        ("DELETE", "/api/v1/runs", 405, {}),
        ("POST", "/queue", 405, {}),
        ("POST", "/api/v1/runs", 413, {"headers": {"content-length": "20000000000"}}),
        ("POST", "/sign-out", 403, {"headers": {"origin": "http://elsewhere.example"}}),
        ("GET", "/runs", 421, {"headers": {"host": "elsewhere.example"}}),
    ],
)
def test_an_error_is_a_page_for_people_and_a_problem_for_programs(
    whole: FastAPI, method: str, path: str, status: int, more: Any
) -> None:
    shown, read = _asked(whole, method, path, BROWSER, **more), _asked(whole, method, path, "*/*", **more)
    assert (shown.status_code, read.status_code) == (status, status)
    assert "text/html" in shown.headers["content-type"] and f"<h1>{TITLES[status]}</h1>" in shown.text
    assert (
        "unsafe" not in shown.headers["content-security-policy"]
        and "script-src 'self'" in shown.headers["content-security-policy"]
    )
    assert ("Open the Lab" in shown.text) == (status not in {403, 413, 421})  # refused before the gate: nobody is known
    if path != "/nowhere/at-all":  # pages answer with pages
        assert read.headers["content-type"] == MEDIA_TYPE and read.json()["status"] == status
        assert html.escape(read.json()["detail"], quote=True).replace("&#x27;", "&#39;") in shown.text
        assert shown.headers["vary"] == "Accept" and shown.headers.get("allow") == read.headers.get("allow")


def test_a_role_that_is_too_low_is_told_on_a_page(whole: FastAPI, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.gate.LOCAL", replace(LOCAL, role=Role.VIEWER))
    answer = _asked(whole, "GET", "/audit", BROWSER)
    assert answer.status_code == 403 and "/audit needs the role engineer" in answer.text
    assert 'data-role="viewer"' in answer.text and "Open the Lab" in answer.text


@pytest.mark.parametrize(("fault", "status"), [(_broken, 500), (_silent, 503), (_contested, 409)])
def test_a_failure_behind_a_page_is_a_page_that_keeps_its_cause_to_the_log(
    whole: FastAPI, monkeypatch: pytest.MonkeyPatch, fault: Any, status: int
) -> None:
    monkeypatch.setattr(whole.state, "sessions", None, raising=False)
    monkeypatch.setattr("app.dependencies.unit_of_work", fault)
    answer = _asked(whole, "GET", "/runs/1?x=1", BROWSER)
    assert answer.status_code == status and f"<h1>{TITLES[status]}</h1>" in answer.text
    assert ('<a href="/runs/1?x=1" class="button">Try again</a>' in answer.text) == (status >= 500)
    assert answer.headers.get("retry-after") == ("5" if status == 503 else None)
    assert "the disk is gone" not in answer.text and "no connection" not in answer.text


def test_a_page_allows_no_script_but_the_services_own(tmp_path: Path) -> None:
    app = _pages_alone(tmp_path)
    answer = TestClient(app).get("/new")
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy and "script-src 'self';" in policy
    assert "unsafe" not in policy
    assert "<script>" not in answer.text and "style=" not in answer.text


def test_addresses_of_the_service_are_never_taken_for_pages(tmp_path: Path) -> None:
    app = _pages_alone(tmp_path)
    client = TestClient(app)
    assert client.get("/nowhere").text.startswith("<!doctype html>")
    assert client.get("/api/v1/nowhere").json() == {"detail": "Not Found"}


def test_the_pages_of_a_list_lead_to_their_neighbours_and_no_further() -> None:
    pages_of = rendering.templates.env.get_template("macros.html").module.pages  # type: ignore[attr-defined]
    first, middle, last = (
        pages_of(first, shown, 52, before, after)
        for first, shown, before, after in (
            (1, 25, "", "/runs?page=2"),
            (26, 25, "/a?b&page=1", "/a?b&page=3"),
            (51, 2, "/p", "/n"),
        )
    )
    assert "1 to 25 of 52" in first and "Previous page" not in first and 'href="/runs?page=2"' in first
    assert 'href="/a?b&amp;page=1"' in middle and 'href="/a?b&amp;page=3"' in middle
    assert "51 to 52 of 52" in last and 'href="/p"' in last and "Next page" not in last
