"""Repeated refusals and warnings in the log are counted, so that a client cannot fill the disk by asking."""

from __future__ import annotations

import io
import logging
from collections.abc import Mapping
from typing import Any

from app import repeats
from app.repeats import MOST, SAME_S, Bounded


class Log:
    """A log with a clock of its own, and its lines."""

    def __init__(self) -> None:
        self.now, self.text = 0.0, io.StringIO()
        self.handler = Bounded(self.text, lambda record: getattr(record, "fields", {}), lambda: self.now)

    def tell(self, event: str, level: Any = logging.WARNING, **fields: object) -> None:
        record = logging.LogRecord("rths.web", level, __file__, 1, event, None, None)
        record.__dict__["fields"] = fields
        self.handler.handle(record)

    @property
    def lines(self) -> list[str]:
        return self.text.getvalue().splitlines()


REFUSED: Mapping[str, object] = {"method": "POST", "route": "/api/v1/stability", "status": 503, "account": "ana"}


def test_refusals_of_one_route_and_account_are_counted_and_said_once_a_minute() -> None:
    log = Log()
    for _ in range(1200):
        log.tell("request", **REFUSED)
    log.tell("request", **{**REFUSED, "account": "bo"})
    assert log.lines == ["request"] * (MOST + 1)
    log.now = SAME_S + 1
    log.handler.say()  # as its timer does
    assert log.lines[MOST + 1 :] == [f"{1200 - MOST} more lines like this within 60 s: request"]
    log.tell("request", **REFUSED)
    assert log.lines[-1] == "request"


def test_answers_and_warnings_about_other_runs_are_all_written() -> None:
    log = Log()
    for number in range(3 * MOST):
        log.tell("request", logging.INFO, method="GET", route="/api/v1/runs", status=200)
        log.tell("the process died", run=f"run {number}")
    assert len(log.lines) == 6 * MOST


def test_what_is_counted_apart_is_bounded() -> None:
    log = Log()
    for number in range(repeats.MOST_KINDS + 5 * MOST):
        log.tell("request", status=404, route=f"/{number}")
    assert len(log.lines) == repeats.MOST_KINDS + MOST
