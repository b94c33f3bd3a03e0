"""SQL of the audit log. Never commits: an entry is stored in the transaction of what it records, or not at all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any, NamedTuple

import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app.audit.chain import Entry, Head, canonical, digest
from app.audit.tables import AuditEntry, AuditHead

WAITING, ACTING = "audit entries", "acting"
CHUNK = 1000
LONGEST = 80  # characters of a name or an action
ENTRY: Any = AuditEntry.__table__
HEAD: Any = AuditHead.__table__
COLUMNS = [ENTRY.c[name] for name in (*Entry._fields, "previous", "hash")]


class Acting(NamedTuple):
    """Who acts: name, role, and how the person signed in; for a program its name, and "worker" or "command line"."""

    who: str
    role: str = ""
    signed_in: str = ""


SERVICE = Acting("service")


def acts(sessions: sessionmaker[Session], who: Acting) -> None:
    """Name who acts in all sessions of a program without requests, such as a worker."""
    sessions.configure(info={ACTING: who})


class Kept(NamedTuple):
    """An entry as it is stored."""

    entry: Entry
    previous: str
    hash: str


class AuditLog:
    """The audit log.

    Entries are written just before the commit: the row of the head, which serialises all writers, is then the last lock that a
    transaction takes, so that two transactions never wait for each other.
    """

    def __init__(self, session: Session):
        self.session = session

    @property
    def acting(self) -> Acting:
        """Who acts in the session of a program; see `acts`."""
        found: Acting = self.session.info.get(ACTING, SERVICE)
        return found

    def add(
        self,
        who: Acting,
        action: str,
        about: str = "",
        details: Mapping[str, Any] | None = None,
        at: datetime | None = None,
    ) -> None:
        """Add an entry when the transaction commits. `at` is its time (default: now)."""
        values = {
            "at": at or datetime.now(UTC),
            **{name: _short(value) for name, value in {**who._asdict(), "action": action, "about": about}.items()},
            "details": canonical(details or {}),
        }
        waiting: list[dict[str, Any]] | None = self.session.info.get(WAITING)
        if waiting is None:
            waiting = self.session.info[WAITING] = []
            sa.event.listen(self.session, "before_commit", _store, once=True)
        waiting.append(values)

    def head(self) -> Head:
        """The last entry, as the row of the head states it."""
        return Head._make(self.session.execute(sa.select(HEAD.c.number, HEAD.c.hash)).one())

    def entries(self) -> Iterator[Kept]:
        """Every entry, the first one first."""
        last = 0
        while True:
            query = sa.select(*COLUMNS).where(ENTRY.c.number > last).order_by(ENTRY.c.number).limit(CHUNK)
            rows = self.session.execute(query).all()
            for row in rows:
                yield Kept(Entry._make(row[:-2]), row.previous, row.hash)
            if len(rows) < CHUNK:
                return
            last = rows[-1].number


def _store(session: Session) -> None:
    """Write the entries of a transaction that is about to commit, after everything else that it writes."""
    session.flush()
    waiting = session.info.pop(WAITING, [])
    locked = sa.update(HEAD).where(HEAD.c.id == 1).values(number=HEAD.c.number).returning(HEAD.c.number, HEAD.c.hash)
    number, last = session.execute(locked).one()
    rows = []
    for values in waiting:
        number += 1
        entry = Entry(number=number, **values)
        rows.append({**entry._asdict(), "previous": last, "hash": digest(last, entry)})
        last = rows[-1]["hash"]
    session.execute(sa.insert(ENTRY), rows)
    session.execute(sa.update(HEAD).where(HEAD.c.id == 1).values(number=number, hash=last))


def _short(text: str) -> str:
    shown = text.replace("\0", "\N{REPLACEMENT CHARACTER}").encode("utf-8", "replace").decode()
    return shown if len(shown) <= LONGEST else f"{shown[: LONGEST - 1]}…"
