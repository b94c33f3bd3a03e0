"""`rths audit`: check, export and head of the audit log of a data folder."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager

from app import db
from app.auditing.service import AuditService
from app.cli.settings import stored
from rths_engine.foundation import files


@contextmanager
def _audit(given: Namespace) -> Iterator[AuditService]:
    settings = stored(given)
    db.migrate(settings.url)
    engine = db.connect(settings.url)
    try:
        with db.unit_of_work(db.sessions(engine)) as session:
            yield AuditService(session)
    finally:
        engine.dispose()


def check(given: Namespace) -> int:
    """`rths audit check`: check the whole chain. Returns 1 where it is broken."""
    with _audit(given) as audit:
        found = audit.check(given.head or "")
    print(found.sentence)
    if found.whole:
        print(f"Head: {found.head.text}")
    return int(not found.whole)


def head(given: Namespace) -> None:
    """`rths audit head`: print the last entry as NUMBER:HASH, to note it elsewhere."""
    with _audit(given) as audit:
        print(audit.head().text)


def export(given: Namespace) -> None:
    """`rths audit export`: write every entry as a line of JSON, the first one first."""
    with _audit(given) as audit:
        if given.out is None:
            sys.stdout.writelines(audit.lines())
            return
        with files.temporary(given.out) as written:
            with written.open("w", encoding="utf-8", newline="\n") as file:
                file.writelines(audit.lines())
            written.replace(given.out)
    print(given.out)
