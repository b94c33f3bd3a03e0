"""Restoration of a backup into an empty place, also of the other kind of database. Nothing that exists is overwritten."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

import sqlalchemy as sa

from app import db
from app.backup import manifest, snapshot
from app.backup.manifest import DATABASE, Manifest
from app.config import Settings
from app.jobs import queue
from app.moving.files import listed
from app.moving.places import seeded
from app.moving.rows import Rows, tables
from app.store.opening import store_of
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

FIX = "give an empty folder and an empty database: a restoration overwrites nothing"


def restore(settings: Settings, folder: Path, told: Callable[[str], None]) -> Manifest:
    """Restore a backup. Raises RthsError for a damaged backup and for a place that is not empty, and then writes nothing."""
    told("checking the backup")
    found = manifest.read(folder)
    manifest.check(folder, found)
    _refuse_full(settings)
    settings.prepared()
    with tempfile.TemporaryDirectory(dir=settings.data, prefix=".restore-") as scratch:
        rows = Path(scratch) / DATABASE
        shutil.copyfile(folder / DATABASE, rows)
        db.migrate(f"sqlite:///{rows}")
        queue.migrate(f"sqlite:///{rows}")
        told("copying files")
        _put_files(settings, folder, found)
        told("copying rows")
        if settings.url.startswith("sqlite"):
            _place(rows, settings)
        else:
            _fill(rows, settings.url)
    _compare(settings, found)
    return found


def _refuse_full(settings: Settings) -> None:
    there = [key for key in listed(store_of(settings))] if settings.data.exists() else []
    if there:
        raise RthsError(Issue("data", f"has {len(there)} files already, such as {there[0]}", str(settings.data), FIX))
    if settings.url.startswith("sqlite"):
        path = _path(settings)
        if path.exists():
            raise RthsError(Issue("database", "exists already", str(path), FIX))
        return
    if db.schemas(settings.url)[0] == "none":
        return
    engine = db.connect(settings.url)
    try:
        with engine.connect() as connection:
            known = set(sa.inspect(connection).get_table_names())
        rows = Rows(engine)
        full = [one.name for one in tables() if one.name in known - seeded() and rows.count(one)]
    finally:
        engine.dispose()
    if full:
        raise RthsError(Issue("database", f"has rows already ({', '.join(full)})", None, FIX))


def _put_files(settings: Settings, folder: Path, found: Manifest) -> None:
    store = store_of(settings)
    for key in found.files:
        if key != DATABASE:
            prefix, _, name = key.rpartition("/")
            copied = store.scratch(prefix) / f".restore-{name}"
            try:
                shutil.copyfile(folder / key, copied)
                files.sync(copied)
                store.put(copied, key)
            finally:
                copied.unlink(missing_ok=True)


def _place(rows: Path, settings: Settings) -> None:
    """Move the SQLite file to its place: the last step, so that a restoration that was interrupted has no database."""
    files.sync(rows)
    rows.rename(_path(settings))
    files.sync(settings.data)


def _fill(path: Path, url: str) -> None:
    db.migrate(url)
    queue.migrate(url)
    engine = db.connect(url)
    try:
        with snapshot.opened(path) as rows:
            snapshot.fill(rows, Rows(engine))
    finally:
        engine.dispose()


def _compare(settings: Settings, found: Manifest) -> None:
    engine = db.connect(settings.url)
    try:
        rows = Rows(engine)
        there = snapshot.counts(rows)
        wrong = [name for name, count in found.rows.items() if name in there and there[name] != count]
        if found.audit and snapshot.audit_head(rows) != found.audit:
            wrong.append("audit_head")
    finally:
        engine.dispose()
    if wrong:
        raise RthsError(Issue("database", f"differs from the backup in {', '.join(wrong)}", None, "restore again"))


def _path(settings: Settings) -> Path:
    return Path(settings.url.removeprefix("sqlite:///"))
