"""Rows for a database of any revision: made from the columns that it has, with foreign keys and plans that exist."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import Any

import sqlalchemy as sa

from rths_engine.planning import templates

AT = datetime(2026, 1, 2, 3, 4, 5, 678_000, tzinfo=UTC)
NOT_FILLED = {"alembic_version", "audit_entry", "audit_head"}  # the chain of hashes has no invented entries
GIVEN = {
    "state": "completed",
    "test": "hybrid",
    "kind": "completed",
    "template": "two-storeys",
    "plan": templates.template("two-storeys").as_dict(),
    "tags": "|one|two|",
    "mapping": {"channels": []},
}
Snapshot = dict[str, dict[tuple[Any, ...], dict[str, Any]]]


def reflected(engine: sa.Engine) -> sa.MetaData:
    found = sa.MetaData()
    found.reflect(engine)
    return found


def fill(engine: sa.Engine) -> None:
    """Add a row to every table that has none."""
    with engine.begin() as connection:
        empty = [name for name in _tables(connection) if not connection.execute(_rows(name).limit(1)).first()]
        found = sa.MetaData()
        found.reflect(connection, only=[name for name in empty if name not in NOT_FILLED])
        for table in found.sorted_tables:
            if table.name in empty and table.name not in NOT_FILLED:
                connection.execute(sa.insert(table), _row(connection, table))


def snapshot(engine: sa.Engine) -> Snapshot:
    """Every row of every table by its primary key, in plain values of the driver: no table is reflected, which takes long."""
    found: Snapshot = {}
    with engine.connect() as connection:
        for name, keys in _tables(connection).items():
            rows = [dict(row) for row in connection.execute(_rows(name)).mappings()]
            found[name] = {tuple(row[key] for key in keys): {k: plain(v) for k, v in row.items()} for row in rows}
    return found


def _tables(connection: sa.Connection) -> dict[str, list[str]]:
    """Every table of the program and its primary key."""
    keys = sa.inspect(connection).get_multi_pk_constraint().items()
    return {name: key["constrained_columns"] for (_, name), key in keys if key and name != "alembic_version"}


def _rows(table: str) -> sa.Select[Any]:
    return sa.select(sa.literal_column("*")).select_from(sa.table(table))


def lost(before: Snapshot, after: Snapshot) -> list[str]:
    """What stood before and does not stand after, as `table.column: value, value after`."""
    found = []
    for table, rows in before.items():
        for key, row in rows.items():
            there = after.get(table, {}).get(key)
            if there is None:
                found.append(f"{table} {key}")
                continue
            found += [
                f"{table}.{name}: {value!r}, {there.get(name)!r}" for name, value in row.items() if there.get(name) != value
            ]
    return found


def common(before: Snapshot, oldest: Snapshot) -> Snapshot:
    """The rows and columns of `before` that the schema of `oldest` has too."""
    return {
        table: {
            key: {name: row[name] for name in next(iter(oldest[table].values()), {}) if name in row}
            for key, row in rows.items()
        }
        for table, rows in before.items()
        if table in oldest
    }


def plain(value: Any) -> Any:
    """A value that compares the same however a driver gives it."""
    if isinstance(value, datetime):
        return (value if value.tzinfo else value.replace(tzinfo=UTC)).isoformat()
    if isinstance(value, str) and value.startswith(("{", "[")):
        return json.loads(value)
    return value


def _row(connection: sa.Connection, table: sa.Table) -> dict[str, Any]:
    row = {}
    for column in table.columns:
        keys = list(column.foreign_keys)
        if keys:
            row[column.name] = connection.scalar(sa.select(keys[0].column).limit(1))
        else:
            row[column.name] = _value(column)
    return row


def _value(column: sa.Column[Any]) -> Any:
    kind = column.type
    if column.name in GIVEN:
        given = GIVEN[column.name]
        return given if isinstance(kind, sa.JSON) or isinstance(given, str) else json.dumps(given)
    if isinstance(kind, sa.JSON):
        return []
    if isinstance(kind, sa.DateTime):
        return AT
    if isinstance(kind, sa.Boolean):
        return True
    if isinstance(kind, sa.Integer):
        return 7
    if isinstance(kind, sa.Numeric | sa.Float):
        return 2.5
    if isinstance(kind, sa.LargeBinary):
        return b"bytes"
    return f"{column.name}"[: getattr(kind, "length", None) or 80]
