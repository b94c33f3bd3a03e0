"""The time that statements take in the database, for the metrics."""

from __future__ import annotations

import time
from typing import Any

import sqlalchemy as sa

from app.metrics import STATEMENT_SECONDS

BEGUN = "rths_statement_begun"


def watch(engine: sa.Engine) -> None:
    """Observe every statement of an engine."""
    sa.event.listen(engine, "before_cursor_execute", _begin)
    sa.event.listen(engine, "after_cursor_execute", _end)


def _begin(connection: sa.Connection, *_: Any) -> None:
    connection.info[BEGUN] = time.perf_counter()


def _end(connection: sa.Connection, *_: Any) -> None:
    STATEMENT_SECONDS.observe(time.perf_counter() - connection.info.pop(BEGUN))
