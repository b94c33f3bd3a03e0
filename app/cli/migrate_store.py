"""`rths migrate-store`: move an installation to another database and store, without loss."""

from __future__ import annotations

import sys
import tempfile
from argparse import Namespace
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

from app.cli.settings import settings
from app.config import Settings
from app.moving.move import move
from app.moving.places import source, target
from rths_engine.foundation.errors import Issue, RthsError


def migrate_store(given: Namespace) -> None:
    """`rths migrate-store`: copy all rows and files, compare them, and say how many there are. The source stays as it is."""
    plain = settings(given)
    with ExitStack() as stack:
        scratch = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="rths-move-")))
        here = _end(plain, "from", given.source, given.from_database, given.from_store, scratch)
        there = _end(plain, "to", given.target, given.to_database, given.to_store, scratch)
        one, other = stack.enter_context(source(here)), stack.enter_context(target(there))
        if one.name == other.name:
            raise RthsError(Issue("--to-database", "is the source itself", other.name, "give another database"))
        moved = move(one, other, given.accept_damaged, lambda doing: print(f"{doing} ...", file=sys.stderr, flush=True))
    print(f"{moved.rows} rows and {moved.files} files are equal in {one.name} and in {other.name}.")
    if moved.damaged:
        print(f"{moved.damaged} files were damaged or missing before, and still are.")
    print("The source is unchanged. Start the control room with the new database and store: docs/scaled-mode.md")


def _end(plain: Settings, word: str, folder: Path | None, database: str | None, store: str | None, scratch: Path) -> Settings:
    """The settings of one end of the move: a data folder, or a database with a store."""
    if (folder is None) == (database is None and store is None):
        fix = "see rths migrate-store -h"
        raise RthsError(Issue(f"--{word}", "needs either a folder or a database with a store", fix=fix))
    if folder is not None:
        return replace(plain, data=folder, database_url="", store="")
    if not database or not store:
        missing = "database" if not database else "store"
        raise RthsError(Issue(f"--{word}-{missing}", "is missing", None, "give both, a database and a store"))
    return replace(plain, data=scratch / word, database_url=database, store=store)
