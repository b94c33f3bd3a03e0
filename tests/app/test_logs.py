"""Logs: one event on each line with what it is about, the same form for libraries and child processes, and no secrets."""

from __future__ import annotations

import io
import json
import logging
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app import logs
from app.observing import HEADER, Observed

LOGGERS = ("", *logs.OWN_HANDLERS, *logs.TALKATIVE, "uvicorn", "uvicorn.error", "uvicorn.access", "alembic")
Lines = Callable[[], list[dict[str, Any]]]


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Put back what `configure` changes."""
    monkeypatch.setattr(logs, "_always", {})
    for key in (logs.FORMAT_KEY, logs.LEVEL_KEY):
        monkeypatch.setenv(key, os.environ.get(key, ""))
    before = [(one, one.handlers[:], one.level, one.propagate) for one in map(logging.getLogger, LOGGERS)]
    yield
    for one, handlers, level, propagate in before:
        one.handlers[:], one.propagate = handlers, propagate
        one.setLevel(level)


@pytest.fixture
def lines(kept: None, monkeypatch: pytest.MonkeyPatch) -> Lines:
    """The lines that were written as JSON since the start of the test."""
    written = io.StringIO()
    monkeypatch.setattr(sys, "stderr", written)
    logs.configure(logs.JSON, "info", worker="bench-2")
    return lambda: [json.loads(line) for line in written.getvalue().splitlines()]


def test_an_event_is_one_line_with_time_level_event_and_what_it_is_about(lines: Lines) -> None:
    with logs.about(run="abc"):
        logging.getLogger("rths.worker").warning("the process died\nonce")
    (line,) = lines()
    assert line["time"].endswith("Z") and line["level"] == "warning" and line["event"] == "the process died\nonce"
    assert (line["run"], line["worker"], line["logger"]) == ("abc", "bench-2", "rths.worker")


def test_libraries_write_in_the_same_form(lines: Lines) -> None:
    for name in ("uvicorn.error", "dbos", "alembic.runtime.migration"):
        logging.getLogger(name).warning("from %s", name)
    assert [line["event"] for line in lines()] == ["from uvicorn.error", "from dbos", "from alembic.runtime.migration"]


@pytest.mark.parametrize(
    ("event", "shown"),
    [
        ("connect to postgresql://rths:hunter2@db/rths failed", "connect to postgresql://[hidden]@db/rths failed"),
        ("GET /sign-in?token=abc.def-1&next=/", "GET /sign-in?token=[hidden]&next=/"),
        ("Authorization: Bearer abc.def", "Authorization: Bearer [hidden]"),
        ("http://127.0.0.1:8000/runs", "http://127.0.0.1:8000/runs"),
    ],
)
def test_passwords_and_tokens_are_never_written(lines: Lines, event: str, shown: str) -> None:
    logging.getLogger("rths").error(event)
    assert lines()[0]["event"] == shown


def test_text_keeps_an_event_on_its_line(kept: None, monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(sys, "stderr", written)
    logs.configure(logs.TEXT, "info")
    logging.getLogger("rths").info("a name\n2026-01-01 info forged")
    assert written.getvalue().count("\n") == 1 and r"a name\n2026" in written.getvalue()


def test_a_child_process_writes_as_its_parent(kept: None) -> None:
    logs.configure(logs.JSON, "warning")
    code = "import logging; from app import logs; logs.inherit(worker='one'); logging.getLogger('rths').warning('hello')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stderr)["event"] == "hello" and json.loads(done.stderr)["worker"] == "one"


def test_a_request_is_logged_under_its_id(lines: Lines, client: TestClient) -> None:
    given = client.get("/api/v1/runs/nothing", headers={HEADER: "from-proxy-1"})
    made = client.get("/api/v1/runs", headers={HEADER: "with spaces"})
    assert given.headers[HEADER] == "from-proxy-1" and len(made.headers[HEADER]) == 16
    first, second = [line for line in lines() if line["event"] == "request"]
    assert (first["request_id"], first["route"], first["status"]) == ("from-proxy-1", "/api/v1/runs/{run_id}", 404)
    assert (second["request_id"], second["method"]) == (made.headers[HEADER], "GET") and second["ms"] >= 0


def test_the_answer_to_an_unexpected_error_names_its_request_and_the_log_has_the_error(
    lines: Lines,
) -> None:
    async def fails(*_: Any) -> None:
        raise ZeroDivisionError("of a test")

    answer = TestClient(Observed(fails)).get("/fails")
    failed = next(line for line in lines() if "error" in line)
    assert answer.status_code == 500 and answer.headers[HEADER] == failed["request_id"]
    assert failed["request_id"] in answer.json()["detail"] and "ZeroDivisionError: of a test" in failed["error"]
