"""The move itself: checks before the first change, copies that can be resumed, and a comparison of everything at the end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sqlalchemy as sa

from app.jobs.states import State
from app.models import Diagnosis, Run, SweepShard
from app.moving import files
from app.moving.places import Place, seeded
from app.moving.rows import key_of, tables
from rths_engine.foundation.errors import Issue, RthsError

MARK = sa.Table("moved_from", sa.MetaData(), sa.Column("source", sa.Text, primary_key=True))
"""In the target until the move is complete: what it is moved from."""
MOST_NAMED = 20


@dataclass(frozen=True, slots=True)
class Moved:
    """Numbers of rows and files that were compared, and of files that were damaged before."""

    rows: int
    files: int
    damaged: int


def move(source: Place, target: Place, accept_damaged: bool, told: Callable[[str], None]) -> Moved:
    """Move everything, or go on with a move that was interrupted. Raises RthsError where it cannot be done without loss."""
    _check_ended(source)
    damaged = files.damaged(source)
    if damaged and not accept_damaged:
        fix = "restore the files from a backup, or move them as they are with --accept-damaged"
        raise RthsError(Issue("--from", f"{_named(list(damaged.values()))} ({len(damaged)} files)", fix=fix))
    _begin(source, target)
    for table in tables():
        told(f"copying rows: {table.name}")
        for batch in source.rows.batches(table):
            there = target.rows.like(table, batch)
            new = [row for row in batch if key_of(table, row) not in there]
            if new:
                target.rows.add(table, new)
    target.rows.set_sequences()
    told("copying files")
    files.copy(source.store, target.store)
    told("comparing rows and files")
    rows = _compared(source, target)
    kept = files.listed(source.store)
    wrong = [key for key in files.different(source.store, target.store) if key in kept]
    if wrong:
        raise RthsError(Issue("--to-store", f"differs from the source in {_named(wrong)}", fix="start the same command again"))
    with target.rows.connect() as connection, connection.begin():
        MARK.drop(connection)
    return Moved(rows, len(kept), len(damaged))


def _check_ended(source: Place) -> None:
    with source.rows.connect() as connection:
        for table in (Run, Diagnosis, SweepShard):
            running = sa.select(sa.func.count()).select_from(table).where(table.state == State.RUNNING)
            count = connection.scalar(running)
            if count:
                fix = "start the control room there, wait until they have ended or cancel them, and stop it"
                raise RthsError(Issue("--from", f"has {count} running jobs ({table.__tablename__})", None, fix))


def _begin(source: Place, target: Place) -> None:
    """Mark an empty target, or find the mark of the same move. Raises RthsError for a target with rows of its own."""
    with target.rows.connect() as connection, connection.begin():
        MARK.create(connection, checkfirst=True)
        marked = connection.scalar(sa.select(MARK.c.source))
    if marked == source.name:
        return
    begun_with = seeded()
    full = [one.name for one in tables() if one.name not in begun_with and target.rows.count(one)]
    if marked is not None or full:
        if marked is None:
            with target.rows.connect() as connection, connection.begin():
                MARK.drop(connection)
        what = f"is the target of a move from {marked}" if marked else f"has rows already ({', '.join(full)})"
        raise RthsError(Issue("--to-database", what, target.name, "give an empty database"))
    for table in reversed(tables()):
        if table.name in begun_with:
            target.rows.clear(table)
    with target.rows.connect() as connection, connection.begin():
        connection.execute(sa.insert(MARK).values(source=source.name))


def _compared(source: Place, target: Place) -> int:
    """The number of rows, all of which are equal. Raises RthsError."""
    total = 0
    for table in tables():
        counts = source.rows.count(table), target.rows.count(table)
        if counts[0] != counts[1]:
            problem = f"has {counts[1]} rows of {table.name}; the source has {counts[0]}"
            raise RthsError(Issue("--to-database", problem, target.name, "give an empty database, and start again"))
        for batch in source.rows.batches(table):
            there = target.rows.like(table, batch)
            wrong = [str(key_of(table, row)) for row in batch if there.get(key_of(table, row)) != row]
            if wrong:
                problem = f"differs from the source in rows of {table.name}: {_named(wrong)}"
                raise RthsError(Issue("--to-database", problem, target.name, "give an empty database, and start again"))
            total += len(batch)
    return total


def _named(found: list[str]) -> str:
    more = f" and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
    return f"{'; '.join(found[:MOST_NAMED])}{more}"
