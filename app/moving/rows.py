"""Rows, copied as they are and compared: JSON as its text, so that not a character of it changes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

import sqlalchemy as sa
from dbos._schemas.system_database import SystemSchema
from sqlalchemy.dialects import postgresql

from app import models
from app.db import Base

assert models  # the import declares every table
BATCH = 500  # rows of one transaction
NOT_MOVED = frozenset({"lease", "worker_heartbeat"})  # they describe processes, none of which runs
QUEUE_SCHEMA = "__dbos_placeholder_schema__"
Row = tuple[Any, ...]


def tables() -> list[sa.Table]:
    """The tables of the application and of its durable queue, those that others refer to first."""
    own = [one for one in Base.metadata.sorted_tables if one.name not in NOT_MOVED]
    return [*own, *SystemSchema.metadata_obj.sorted_tables]


@dataclass(frozen=True, slots=True)
class Rows:
    """The rows of a database."""

    engine: sa.Engine

    @property
    def postgres(self) -> bool:
        return self.engine.dialect.name == "postgresql"

    def connect(self) -> sa.Connection:
        schema = "dbos" if self.postgres else None
        return self.engine.connect().execution_options(schema_translate_map={QUEUE_SCHEMA: schema})

    def count(self, table: sa.Table) -> int:
        with self.connect() as connection:
            return connection.scalar(sa.select(sa.func.count()).select_from(table)) or 0

    def batches(self, table: sa.Table) -> Iterator[list[Row]]:
        """All rows, BATCH at a time."""
        with self.connect() as connection:
            found = connection.execution_options(yield_per=BATCH).execute(_select(table).order_by(*_key(table)))
            while batch := [tuple(row) for row in islice(found, BATCH)]:
                yield batch

    def like(self, table: sa.Table, rows: Sequence[Row]) -> dict[Row, Row]:
        """The rows here with the keys of `rows`, by these keys."""
        keys = [key_of(table, row) for row in rows]
        with self.connect() as connection:
            where = sa.tuple_(*_key(table)).in_(keys)
            return {key_of(table, row): row for row in map(tuple, connection.execute(_select(table).where(where)))}

    def add(self, table: sa.Table, rows: Sequence[Row]) -> None:
        """Insert rows in one transaction."""
        values = {one.name: _bound(one, self.postgres) for one in table.columns}
        names = [f"v_{one.name}" for one in table.columns]
        with self.connect() as connection, connection.begin():
            connection.execute(sa.insert(table).values(values), [dict(zip(names, row, strict=True)) for row in rows])

    def clear(self, table: sa.Table) -> None:
        with self.connect() as connection, connection.begin():
            connection.execute(sa.delete(table))

    def set_sequences(self) -> None:
        """Let the next numbers follow the highest ones."""
        if not self.postgres:
            return  # SQLite takes the next number by itself
        with self.connect() as connection, connection.begin():
            for table in tables():
                schema = "dbos." if table.schema else ""
                for column in table.columns:
                    if isinstance(column.type, sa.Integer):
                        named = sa.func.pg_get_serial_sequence(f'{schema}"{table.name}"', column.name)
                        sequence = connection.scalar(sa.select(named))
                        if sequence:
                            highest = connection.scalar(sa.select(sa.func.max(column)))
                            connection.execute(sa.select(sa.func.setval(sequence, highest or 1, highest is not None)))


def key_of(table: sa.Table, row: Row) -> Row:
    """The primary key of a row."""
    names = {one.name for one in _key(table)}
    return tuple(value for one, value in zip(table.columns, row, strict=True) if one.name in names)


def _key(table: sa.Table) -> list[sa.Column[Any]]:
    """The columns that tell rows apart, in the order of the table."""
    names = {one.name for one in table.primary_key.columns}
    return [one for one in table.columns if one.name in names or not names]


def _select(table: sa.Table) -> sa.Select[Any]:
    return sa.select(*(sa.cast(one, sa.Text).label(one.name) if _json(one) else one for one in table.columns))


def _bound(column: sa.Column[Any], postgres: bool) -> Any:
    """The parameter of a column: JSON is given as its text."""
    if not _json(column):
        return sa.bindparam(f"v_{column.name}", type_=column.type)
    text = sa.bindparam(f"v_{column.name}", type_=sa.Text())
    return sa.cast(text, postgresql.JSON) if postgres else sa.type_coerce(text, sa.Text)


def _json(column: sa.Column[Any]) -> bool:
    return isinstance(column.type, sa.JSON)
