"""The rows of an installation at one moment, as a SQLite database, while the service goes on."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from app import db
from app.audit.tables import AuditHead
from app.jobs import queue
from app.moving.places import seeded
from app.moving.rows import Rows, tables


def take(url: str, path: Path) -> None:
    """Write the rows of a database into a new SQLite file.

    SQLite copies its own file, also while others write. PostgreSQL shows every table at one moment, and each row is copied.
    """
    if url.startswith("sqlite"):
        db.check_exists(url)
        source = Path(url.removeprefix("sqlite:///"))
        with closing(sqlite3.connect(f"file:{source}?mode=ro", uri=True)) as there, closing(sqlite3.connect(path)) as here:
            there.backup(here)
            here.execute("pragma journal_mode=delete")  # one file
        return
    db.check_schema(url)
    with frozen(url) as rows:
        copy(rows, path)


def copy(rows: Rows, path: Path) -> None:
    """Copy every row into a new SQLite file."""
    target = f"sqlite:///{path}"
    db.migrate(target)
    queue.migrate(target)
    engine = db.connect(target)
    try:
        fill(rows, Rows(engine))
        with engine.connect() as connection:
            connection.execute(sa.text("pragma wal_checkpoint(truncate)"))
            connection.execute(sa.text("pragma journal_mode=delete"))
    finally:
        engine.dispose()


def fill(source: Rows, target: Rows) -> None:
    """Copy every row into an empty database of the same schema."""
    begun_with = seeded()
    for table in reversed(tables()):
        if table.name in begun_with:
            target.clear(table)
    for table in tables():
        for batch in source.batches(table):
            target.add(table, batch)
    target.set_sequences()


def counts(rows: Rows) -> dict[str, int]:
    """The number of rows of each table of the application."""
    with rows.connect() as connection:
        known = set(sa.inspect(connection).get_table_names())
    return {table.name: rows.count(table) for table in tables() if not table.schema and table.name in known}


def audit_head(rows: Rows) -> dict[str, Any]:
    """Number and hash of the last entry of the audit log; empty in a database from before the audit log."""
    with rows.connect() as connection:
        if not sa.inspect(connection).has_table(AuditHead.__tablename__):
            return {}
        found = connection.execute(sa.select(AuditHead.number, AuditHead.hash)).one()
        return {"number": found.number, "hash": found.hash}


@contextmanager
def opened(path: Path) -> Iterator[Rows]:
    """The rows of a SQLite file."""
    engine = db.connect(f"sqlite:///{path}")
    try:
        yield Rows(engine)
    finally:
        engine.dispose()


@contextmanager
def frozen(url: str) -> Iterator[Rows]:
    """The rows of a PostgreSQL database at one moment: every connection of these rows sees the same snapshot."""
    keeping, engine = db.connect(url), db.connect(url)
    isolated = engine.execution_options(isolation_level="REPEATABLE READ")
    try:
        with keeping.connect().execution_options(isolation_level="REPEATABLE READ") as keeper, keeper.begin():
            snapshot = keeper.scalar(sa.text("SELECT pg_export_snapshot()"))

            def join(connection: Any) -> None:
                with connection.connection.dbapi_connection.cursor() as cursor:  # those of the engine are for selects
                    cursor.execute(f"SET TRANSACTION SNAPSHOT '{snapshot}'")

            sa.event.listen(isolated, "begin", join)
            yield Rows(isolated)
    finally:
        keeping.dispose()
        engine.dispose()
