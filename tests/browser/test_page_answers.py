"""What pages answer before any browser sees them: errors as pages, and headers that keep them to this service's own parts."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from fastapi.testclient import TestClient

from app import pages
from app.config import Settings
from app.pages import rendering
from app.runs.dependency import run_service


def _pages_alone(data: Path) -> FastAPI:
    app = FastAPI()
    app.state.settings = Settings(data)
    app.include_router(pages.router)
    return app


def _broken() -> None:
    raise RuntimeError("the disk is gone")


def test_a_failure_of_the_service_is_a_page_that_keeps_its_cause_to_the_log(tmp_path: Path) -> None:
    app = _pages_alone(tmp_path)
    app.dependency_overrides[run_service] = _broken
    answer = TestClient(app).get("/runs/1")
    assert answer.status_code == 500
    assert "<h1>Internal server error</h1>" in answer.text
    assert "the disk is gone" not in answer.text


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
