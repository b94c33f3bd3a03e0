"""Tasks that one of several web processes does: it holds a lease in the database, which another takes over after its end."""

from __future__ import annotations

import os
import secrets
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime, timedelta

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, Session, mapped_column, sessionmaker

from app.db import INSERT, Base, connect, now, unit_of_work

TERM = timedelta(seconds=15)  # after which another process takes over from one that has died
RENEWED_S = TERM.total_seconds() / 3
ASKED_S = 0.2  # between two asks for a lock; one that waited in the database would block the indexes that the other creates
STARTING = 0x52746873  # key of the lock of PostgreSQL; chosen: the bytes of "Rths"


class Lease(Base):
    """Which process does a task, and until when by the clock of the database."""

    __tablename__ = "lease"

    name: Mapped[str] = mapped_column(sa.String(40), primary_key=True)
    holder: Mapped[str] = mapped_column(sa.String(120))
    until: Mapped[datetime]


class Once:
    """Lets one process at a time do a task."""

    def __init__(self, maker: sessionmaker[Session]):
        self.maker = maker
        self.holder = f"{socket.gethostname()}-{os.getpid()}-{secrets.token_hex(3)}"
        self._renewed: dict[str, float] = {}

    def held(self, name: str) -> bool:
        """Whether this process does the task now; it takes the lease where nobody holds it, and renews its own."""
        if time.monotonic() - self._renewed.get(name, -RENEWED_S) < RENEWED_S:
            return True
        with unit_of_work(self.maker) as session:
            taken = self._take(session, name)
        if taken:
            self._renewed[name] = time.monotonic()
        return taken

    def release(self, name: str) -> None:
        """Give the task to whoever asks next."""
        if self._renewed.pop(name, None) is not None:
            mine = (Lease.name == name) & (Lease.holder == self.holder)
            with unit_of_work(self.maker) as session:
                session.execute(sa.delete(Lease).where(mine))

    def _take(self, session: Session, name: str) -> bool:
        moment = now(session)
        ended = ~Lease.until.between(moment, moment + 2 * TERM)  # also one that a clock set back has left in the future
        values = {"holder": self.holder, "until": moment + TERM}
        change = sa.update(Lease).where(Lease.name == name, (Lease.holder == self.holder) | ended).values(values)
        if session.execute(change, execution_options={"synchronize_session": False}).rowcount:  # type: ignore[attr-defined]
            return True
        added = INSERT[session.get_bind().dialect.name](Lease).values(name=name, **values).on_conflict_do_nothing()
        return bool(session.execute(added).rowcount)  # type: ignore[attr-defined]


@contextmanager
def alone(url: str) -> Iterator[None]:
    """The processes of one PostgreSQL database pass one after another, for example when they migrate it.

    A SQLite database locks itself while it is migrated.
    """
    engine = connect(url)
    try:
        if engine.dialect.name == "sqlite":
            yield
            return
        with engine.connect() as plain:
            connection = plain.execution_options(isolation_level="AUTOCOMMIT")
            while not connection.scalar(sa.select(sa.func.pg_try_advisory_lock(STARTING))):
                time.sleep(ASKED_S)
            yield  # the end of the connection ends the lock
    finally:
        engine.dispose()
