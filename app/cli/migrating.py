"""`rths migrate`: the database to the newest schema, or to an earlier one after saying what that loses."""

from __future__ import annotations

import tempfile
from argparse import Namespace
from pathlib import Path

import sqlalchemy as sa
from alembic import command

from app import db
from app.cli.settings import stored
from app.jobs import queue
from app.leases import alone
from rths_engine.foundation.errors import Issue, RthsError

SAFE = "make a backup with `rths backup`, then repeat this with --accept-loss"


def migrate(given: Namespace) -> None:
    """`rths migrate`: bring the database and its queue to the newest schema, or the database to that of `--to`."""
    settings = stored(given)
    with alone(settings.url):
        if given.to is None:
            db.migrate(settings.url)
            queue.migrate(settings.url)
        else:
            _to(settings.url, given.to, given.accept_loss)
            given.recorded = False  # an earlier schema may have no audit log


def _to(url: str, revision: str, accept_loss: bool) -> None:
    found, known = db.schemas(url)
    if revision not in known:
        raise RthsError(Issue("--to", f"is not a schema of this version ({known[-1]} to {known[0]})", revision))
    if found not in (*known, "none"):
        raise RthsError(Issue("database", "has the schema of a newer version", found, "migrate it with that version"))
    if found == "none" or known.index(revision) <= known.index(found):
        command.upgrade(db.alembic_config(url), revision)
        return
    going = list(lost(url, revision))
    if going and not accept_loss:
        raise RthsError(Issue("--to", f"has no place for {'; '.join(going)}", revision, SAFE))
    command.downgrade(db.alembic_config(url), revision)
    print(f"The database has schema {revision}. Lost: {'; '.join(going) or 'nothing'}.")
    print("Start it with the version of the program that has this schema: this one would migrate it up again.")


def lost(url: str, revision: str) -> list[str]:
    """Tables with rows, and columns with values, that the schema of a revision does not have under that name."""
    with tempfile.TemporaryDirectory(prefix="rths-migrate-") as folder:
        older = f"sqlite:///{Path(folder) / 'older.sqlite'}"
        command.upgrade(db.alembic_config(older), revision)
        kept = {name: set(table.columns.keys()) for name, table in _reflected(older).tables.items()}
    found = []
    engine = db.connect(url)
    try:
        own = set(db.Base.metadata.tables)
        with engine.connect() as connection:
            for name, table in _reflected(url).tables.items():
                for column in table.columns if name in kept and name in own else ():
                    if column.name not in kept[name]:
                        count = connection.scalar(sa.select(sa.func.count(column)))
                        found += [f"{count} values of {name}.{column.name}"] if count else []
                if name in own and name not in kept:
                    count = connection.scalar(sa.select(sa.func.count()).select_from(table))
                    found += [f"{count} rows of {name}"] if count else []
    finally:
        engine.dispose()
    return found


def _reflected(url: str) -> sa.MetaData:
    engine, found = db.connect(url), sa.MetaData()
    try:
        found.reflect(engine)
    finally:
        engine.dispose()
    return found
