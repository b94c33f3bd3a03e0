"""What pages answer before any browser sees them: errors as pages, and headers that keep them to this service's own parts."""

from __future__ import annotations

from fastapi import FastAPI
from fastapi.testclient import TestClient

from app import pages
from app.runs.dependency import run_service


def _broken() -> None:
    raise RuntimeError("the disk is gone")


def test_a_failure_of_the_service_is_a_page_that_keeps_its_cause_to_the_log() -> None:
    app = FastAPI()
    app.include_router(pages.router)
    app.dependency_overrides[run_service] = _broken
    answer = TestClient(app).get("/runs")
    assert answer.status_code == 500
    assert "<h1>The service failed</h1>" in answer.text
    assert "the disk is gone" not in answer.text


def test_a_page_allows_no_script_but_the_services_own() -> None:
    app = FastAPI()
    app.include_router(pages.router)
    answer = TestClient(app).get("/new")
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy and "script-src 'self';" in policy
    assert "unsafe" not in policy
    assert "<script>" not in answer.text and "style=" not in answer.text


def test_addresses_of_the_service_are_never_taken_for_pages() -> None:
    app = FastAPI()
    app.include_router(pages.router)
    client = TestClient(app)
    assert client.get("/nowhere").text.startswith("<!doctype html>")
    assert client.get("/api/v1/nowhere").json() == {"detail": "Not Found"}
