"""The two ends of a move: a database with a store."""

from __future__ import annotations

import fcntl
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import IO

import sqlalchemy as sa

from app import db
from app.config import Settings
from app.jobs import queue
from app.jobs.workers import Workers
from app.leases import alone
from app.moving.rows import Rows, tables
from app.store.base import Store
from app.store.opening import store_of
from rths_engine.foundation.errors import Issue, RthsError

IN_USE = "in-use.lock"


@dataclass(frozen=True, slots=True)
class Place:
    """A database and a store, and what people call them."""

    name: str
    rows: Rows
    store: Store


def using(settings: Settings) -> IO[str]:
    """A file whose lock says that a web service or a worker uses the data folder."""
    file = (settings.prepared().data / IN_USE).open("a+")
    fcntl.flock(file, fcntl.LOCK_SH)
    return file


@contextmanager
def source(settings: Settings) -> Iterator[Place]:
    """The place that is moved; nothing of it is changed. Raises RthsError where it is none, or in use by a service or a worker.

    A database of SQLite is copied first, and the copy brought to the newest schema.
    """
    db.check_exists(settings.url)
    with _unused(settings), tempfile.TemporaryDirectory(prefix="rths-move-") as folder:
        url = settings.url
        if url.startswith("sqlite"):
            url = f"sqlite:///{_copied(Path(url.removeprefix('sqlite:///')), Path(folder))}"
            db.migrate(url)
            queue.migrate(url)
        else:
            db.check_schema(url)
        with _opened(settings, url) as place:
            with db.unit_of_work(db.sessions(place.rows.engine)) as session:
                workers = Workers(session)
                if workers.alive(workers.last_beat()):
                    raise _busy("a worker uses it", place.name)
            yield place


@contextmanager
def target(settings: Settings) -> Iterator[Place]:
    """The place that is moved to, with the newest schema. Raises RthsError while a service or a worker uses it."""
    with _unused(settings):
        with alone(settings.url):
            db.migrate(settings.url)
            queue.migrate(settings.url)
        with _opened(settings, settings.url) as place:
            yield place


@cache
def seeded() -> frozenset[str]:
    """Names of the tables in which every new database has rows."""
    with tempfile.TemporaryDirectory(prefix="rths-move-") as folder:
        url = f"sqlite:///{folder}/new.sqlite"
        db.migrate(url)
        queue.migrate(url)
        engine = db.connect(url)
        rows = Rows(engine)
        found = frozenset(one.name for one in tables() if rows.count(one))
        engine.dispose()
    return found


@contextmanager
def _opened(settings: Settings, url: str) -> Iterator[Place]:
    engine = db.connect(url)
    try:
        store = store_of(settings)
        shown = sa.make_url(settings.url).render_as_string(hide_password=True)
        yield Place(f"{shown} with {store.where}", Rows(engine), store)
    finally:
        engine.dispose()


@contextmanager
def _unused(settings: Settings) -> Iterator[None]:
    with (settings.prepared().data / IN_USE).open("a+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise _busy("a web service or a worker uses it", str(settings.data)) from None
        yield


def _busy(problem: str, place: str) -> RthsError:
    return RthsError(Issue("data", problem, place, "stop every `rths serve` and `rths worker` first"))


def _copied(path: Path, folder: Path) -> Path:
    copy = folder / "rths.sqlite"
    with closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as there, closing(sqlite3.connect(copy)) as here:
        there.backup(here)
    return copy
