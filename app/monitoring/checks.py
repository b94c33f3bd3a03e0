"""The checks of readiness: database, schema, store, disk, worker and clock, each with its reason."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from functools import cache

import sqlalchemy as sa
from alembic.script import ScriptDirectory
from sqlalchemy.orm import Session, sessionmaker

from app import db, disk
from app.config import Settings
from app.db import alembic_config, unit_of_work
from app.events.tables import Event
from app.full import FIX
from app.jobs.tables import WorkerHeartbeat
from app.jobs.workers import WORKER_SILENCE, Workers
from app.monitoring.schemas import Check, Readiness
from app.store.filed import RECORDINGS
from app.store.opening import store_of

CLOCKS_APART = timedelta(seconds=5)


def readiness(settings: Settings, maker: sessionmaker[Session]) -> Readiness:
    """Look at everything that the service needs. What cannot be looked at is not ready."""
    checks = [*_of_database(settings, maker), _of_store(settings), _of_disk(settings)]
    return Readiness(ready=all(one.ok for one in checks), checks=checks)


def silent(seconds: float) -> Readiness:
    """The answer where the checks themselves did not end in time."""
    reason = f"The checks did not end within {seconds:g} s: the database or the store does not answer."
    return Readiness(ready=False, checks=[Check(name="checks", ok=False, reason=reason)])


def _of_database(settings: Settings, maker: sessionmaker[Session]) -> Iterator[Check]:
    looks: tuple[Callable[[Settings, Session], Check], ...] = (_of_schema, _of_worker, _of_clock)
    try:
        with unit_of_work(maker) as session:
            found = [look(settings, session) for look in looks]
    except sa.exc.SQLAlchemyError as error:
        said = str(getattr(error, "orig", error)).splitlines()[0]
        yield Check(name="database", ok=False, reason=f"The database did not answer: {said}.")
        return
    yield Check(name="database", ok=True, reason="The database answers.")
    yield from found


def _of_schema(_: Settings, session: Session) -> Check:
    found = session.scalar(sa.text("SELECT version_num FROM alembic_version"))
    wanted = _newest()
    said = f"The database has schema {found}"
    if found == wanted:
        return Check(name="schema", ok=True, reason=f"{said}.")
    return Check(
        name="schema", ok=False, reason=f"{said}; this version needs {wanted}. Run 'rths migrate', or start its version."
    )


@cache
def _newest() -> str | None:
    """The schema of this program."""
    return ScriptDirectory.from_config(alembic_config("")).get_current_head()


def _of_worker(_: Settings, session: Session) -> Check:
    alive = len([seen for seen in Workers(session).beats().values() if Workers(session).alive(seen)])
    if alive:
        return Check(name="worker", ok=True, reason=f"{alive} worker{'s' if alive > 1 else ''} alive.")
    silence = WORKER_SILENCE.total_seconds()
    reason = f"No worker wrote a heartbeat in the last {silence:g} s. Start 'rths worker', or look at its log."
    return Check(name="worker", ok=False, reason=reason)


def _of_clock(_: Settings, session: Session) -> Check:
    """The clock agrees with that of the database server and is not behind what is stored.

    A clock that was set right leaves later times behind for ever: they are only told where a worker lives by the present clock.
    """
    now, fix = datetime.now(UTC), "Set the clocks, for example with NTP."
    ahead = abs((db.now(session) - now).total_seconds())
    if ahead > CLOCKS_APART.total_seconds():
        reason = f"The clocks of this machine and of the database are {ahead:.0f} s apart. {fix}"
        return Check(name="clock", ok=False, reason=reason)
    newest = max(filter(None, (session.scalar(sa.select(sa.func.max(column))) for column in _TIMES)), default=now)
    if newest - now <= CLOCKS_APART:
        return Check(name="clock", ok=True, reason="The clock agrees with the database.")
    later = f"The database has times up to {(newest - now).total_seconds():.0f} s later than the clock of this machine"
    workers = Workers(session)
    if workers.alive(workers.last_beat()):
        reason = f"{later}: the clock was set back. If it is right now, nothing is to be done. If it is not: {fix}"
        return Check(name="clock", ok=True, reason=reason)
    return Check(name="clock", ok=False, reason=f"{later}. {fix} If it is right now, start a worker.")


_TIMES = (WorkerHeartbeat.seen_at, Event.at)


def _of_store(settings: Settings) -> Check:
    """A file can be written where recordings go."""
    name = f".ready-{secrets.token_hex(4)}"
    try:
        store = store_of(settings)
        path = store.scratch(RECORDINGS) / name
        try:
            path.write_bytes(b"ready")
            store.put(path, f"{RECORDINGS}/{name}")
        finally:
            path.unlink(missing_ok=True)
            store.delete(f"{RECORDINGS}/{name}")
    except OSError as error:
        reason = f"No recording can be stored: {error.strerror or error}. Mend the rights, the disk or the connection."
        return Check(name="store", ok=False, reason=reason)
    return Check(name="store", ok=True, reason="Recordings can be stored.")


def _of_disk(settings: Settings) -> Check:
    try:
        found = disk.space(settings)
    except OSError as error:
        return Check(name="disk", ok=False, reason=f"The data folder cannot be looked at: {error.strerror or error}.")
    fix = f". New tests and uploads are refused. {FIX}." if found.low else "."
    return Check(name="disk", ok=not found.low, reason=f"{found.sentence}{fix}")
