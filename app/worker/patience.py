"""Patience with a database that does not answer for a while: what is done, is done soon after it answers again."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any, TypeVar

import sqlalchemy as sa

from app.db import DATABASE_SILENT, connect

log = logging.getLogger("rths.worker")
PAUSES_S = (0.1, 0.2, 0.5, 1.0, 2.0)  # the last again and again
BUSY_TIMEOUT_MS = 3_600_000  # of the queue's connections to SQLite
Answer = TypeVar("Answer")


def patiently(action: Callable[[], Answer]) -> Answer:
    """Do `action`, which is one transaction, again and again until the database answers: an outage ends no test."""
    return _again(action, DATABASE_SILENT)


def patient_engine(url: str) -> sa.Engine:
    """The engine of the durable queue: its connections wait for a database that is away, and for a lock of SQLite.

    DBOS doubles its pauses after each failure, up to 90 s, so it would stand still long after the database is back. Here it
    sees no failure while the database is away, and goes on PAUSES_S after the end of the outage.
    """
    engine = connect(url)
    sa.event.listen(engine, "do_connect", _connect)
    if engine.dialect.name == "sqlite":
        sa.event.listen(engine, "connect", _wait_for_locks)
    return engine


def _again(action: Callable[[], Answer], silent: tuple[type[Exception], ...]) -> Answer:
    tried = 0
    while True:
        try:
            return action()
        except silent as error:
            pause = PAUSES_S[min(tried, len(PAUSES_S) - 1)]
            log.warning("the database did not answer, next try in %g s: %s", pause, error.__cause__ or error)
            time.sleep(pause)
            tried += 1


def _connect(dialect: Any, _: Any, arguments: Any, parameters: Any) -> Any:
    return _again(lambda: dialect.connect(*arguments, **parameters), (dialect.loaded_dbapi.OperationalError,))


def _wait_for_locks(connection: Any, _: Any) -> None:
    connection.execute(f"pragma busy_timeout={BUSY_TIMEOUT_MS}")
