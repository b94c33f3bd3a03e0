"""Database connection, sessions, migration, and the base of every table."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ClassVar, Literal, TypeVar, cast

import sqlalchemy as sa
from alembic import command
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.orm import DeclarativeBase, InstrumentedAttribute, Session, sessionmaker

from rths_engine.foundation.errors import Issue, RthsError

MIGRATIONS = Path(__file__).parent.parent / "migrations"
BUSY_TIMEOUT_MS = 30_000
CONNECTIONS = 64  # more than the threads that ask for one: those of requests (40), of the queue and of webhooks
LOCK_WAIT_S = 30
IDLE_S = 40  # a transaction of a process that does nothing, as a frozen one: the server ends it, and others get its locks
CUT_S = 10  # after which a connection counts as cut at both ends: otherwise a worker that was cut off keeps its locks for hours

INSERT: dict[str, Any] = {"sqlite": sqlite.insert, "postgresql": postgresql.insert}
"""By dialect, an insert that says what to do where a row with this key exists."""

ONLY_LOCKS = "only_locks"
"""The option of a statement that locks rows and changes none."""

DATABASE_SILENT = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.InternalError, sa.exc.TimeoutError)
"""Errors of a database that is away, full, locked or has ended the connection or the transaction: it may succeed later."""


class UtcDateTime(sa.TypeDecorator[datetime]):
    """Column of UTC times that carry their time zone, in every database."""

    impl = sa.DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: sa.Dialect) -> datetime | None:
        return value.astimezone(UTC) if value else None

    def process_result_value(self, value: datetime | None, dialect: sa.Dialect) -> datetime | None:
        return value.replace(tzinfo=UTC) if value and value.tzinfo is None else value


class Tags(sa.TypeDecorator[list[str]]):
    """Column of a few words, stored as `|one|another|` so that LIKE finds a whole word; empty text without words."""

    impl = sa.Text
    cache_ok = True

    def process_bind_param(self, value: list[str] | None, dialect: sa.Dialect) -> str:
        return f"|{'|'.join(value)}|" if value else ""

    def process_result_value(self, value: str | None, dialect: sa.Dialect) -> list[str]:
        return value.strip("|").split("|") if value else []


class Base(DeclarativeBase):
    """Base of the tables; times are stored in UTC and dictionaries as JSON."""

    type_annotation_map: ClassVar = {datetime: UtcDateTime, dict[str, Any]: sa.JSON}


Row = TypeVar("Row", bound=Base)


def connect(url: str) -> sa.Engine:
    """The database engine for a URL.

    Connections to SQLite use write-ahead logging, foreign keys and a busy timeout, and take the lock of the database at the
    start of a transaction that writes. Connections to PostgreSQL notice at both ends when the network between them is cut.
    """
    sqlite = url.startswith("sqlite")
    engine = sa.create_engine(
        url.replace("postgresql:", "postgresql+psycopg:", 1),
        pool_pre_ping=True,
        pool_size=8,
        max_overflow=CONNECTIONS - 8,
        connect_args={} if sqlite else _POSTGRES,
    )
    if sqlite:
        sa.event.listen(engine, "connect", _prepare_sqlite)
    return engine


class Reopened(Session):
    """A session that is opened anew in the process of a calculation: a service goes there with its session."""

    def __reduce__(self) -> tuple[Callable[[str], Session], tuple[str]]:
        return _reopened, (self.get_bind().engine.url.render_as_string(hide_password=False),)


def _reopened(url: str) -> Session:
    return sessions(connect(url))()


def sessions(engine: sa.Engine) -> sessionmaker[Session]:
    """The factory of sessions; their rows stay readable after a commit."""
    return sessionmaker(engine, class_=Reopened, expire_on_commit=False)


def now(session: Session) -> datetime:
    """The time by the clock of the database: the same for every machine. SQLite has the clock of this machine."""
    if session.get_bind().dialect.name == "sqlite":
        return datetime.now(UTC)
    told: datetime = session.execute(sa.select(sa.func.clock_timestamp())).scalar_one()
    return told.astimezone(UTC)


def put(session: Session, table: type[Base], key: str, **row: object) -> None:
    """Insert a row, or change the one with its key, in one statement: of two processes that do so at once none fails."""
    insert = INSERT[session.get_bind().dialect.name](table).values(row)
    new = {name: insert.excluded[name] for name in row if name != key}
    session.execute(insert.on_conflict_do_update(index_elements=[key], set_=new))


def locked(session: Session, table: type[Row], **key: object) -> Row | None:
    """The row with this key as it is now, locked against other writers until the end of the transaction; None without one."""
    lock(session, getattr(table, next(iter(key))), *(getattr(table, name) == value for name, value in key.items()))
    return session.scalar(sa.select(table).filter_by(**key).execution_options(populate_existing=True))


def lock(session: Session, kept: InstrumentedAttribute[Any], *where: sa.ColumnElement[bool]) -> bool:
    """Lock rows against other writers until the end of the transaction; returns whether there are any.

    An update sets their column `kept` to itself. In SQLite, which has no SELECT FOR UPDATE, it locks the database. What the
    caller read before may have changed meanwhile, so it reads again.
    """
    untouched = sa.update(kept.class_).where(*where).values({kept: kept})
    found = session.execute(untouched, execution_options={"synchronize_session": False, ONLY_LOCKS: True})
    return bool(cast(Any, found).rowcount)


@contextmanager
def unit_of_work(maker: sessionmaker[Session]) -> Iterator[Session]:
    """One session that commits once at the end, or rolls everything back."""
    with maker() as session, session.begin():
        yield session


def afterwards(session: Session, event: Literal["after_commit", "after_rollback"], action: Callable[[], Any]) -> None:
    """Do `action` when the transaction has ended with `event`, so that changes of files follow the changes of rows."""
    sa.event.listen(session, event, lambda _: action(), once=True)


def migrate(url: str) -> None:
    """Bring the database to the newest schema. Raises RthsError for a database of a newer version of the program."""
    _refuse_newer(*schemas(url))
    command.upgrade(alembic_config(url), "head")


def check_exists(url: str) -> None:
    """Raise RthsError where there is no database of this program; changes nothing. PostgreSQL says so itself."""
    path = Path(url.removeprefix("sqlite:///"))
    if url.startswith("sqlite") and not _has_schema(path):
        fix = "give the data folder of a control room with --data, or make one with 'rths migrate' or 'rths serve'"
        raise RthsError(Issue("data", "has no database", str(path.parent), fix))


def _has_schema(path: Path) -> bool:
    """Whether a SQLite file is a database that was migrated, read without a change of the file."""
    try:
        with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as connection:
            return connection.execute("SELECT 1 FROM sqlite_master WHERE name = 'alembic_version'").fetchone() is not None
    except sqlite3.OperationalError:  # there is no such file
        return False
    except sqlite3.DatabaseError:  # it is damaged, which whoever opens it says
        return True


def check_schema(url: str) -> None:
    """Raise RthsError unless the schema of the database is the one of this program."""
    check_exists(url)
    found, known = schemas(url)
    _refuse_newer(found, known)
    if found != known[0]:
        fix = "run 'rths migrate', or start 'rths serve', which does the same"
        raise RthsError(Issue("database", f"has the schema of an older version of the program (needs {known[0]})", found, fix))


def schemas(url: str) -> tuple[str, list[str]]:
    """The schema of the database ("none" without one), and the schemas that this program knows, newest first."""
    engine = connect(url)
    try:
        with engine.connect() as connection:
            found = MigrationContext.configure(connection).get_current_revision()
    finally:
        engine.dispose()
    known = ScriptDirectory.from_config(alembic_config(url)).walk_revisions()
    return found or "none", [one.revision for one in known]


def _refuse_newer(found: str, known: list[str]) -> None:
    if found not in (*known, "none"):
        fix = "install that version here too: older programs cannot read it"
        raise RthsError(
            Issue("database", f"has the schema of a newer version of the program (known to {known[0]})", found, fix)
        )


def alembic_config(url: str, folder: Path | None = None) -> Config:
    """Alembic's configuration for the database at `url`, with the migrations in `folder` (default: MIGRATIONS)."""
    config = Config()
    config.set_main_option("script_location", str(folder or MIGRATIONS).replace("%", "%%"))
    config.attributes["url"] = url
    return config


_POSTGRES = {
    "connect_timeout": CUT_S,
    "keepalives_idle": CUT_S // 2,
    "keepalives_interval": 2,
    "keepalives_count": 3,
    "tcp_user_timeout": CUT_S * 1000,
    "options": " ".join(
        f"-c {name}={value}"
        for name, value in {
            "tcp_keepalives_idle": CUT_S // 2,
            "tcp_keepalives_interval": 2,
            "tcp_keepalives_count": 3,
            "tcp_user_timeout": CUT_S * 1000,
            "lock_timeout": LOCK_WAIT_S * 1000,
            "idle_in_transaction_session_timeout": IDLE_S * 1000,
        }.items()
    ),
}


def _prepare_sqlite(connection: Any, _: Any) -> None:
    connection.isolation_level = "IMMEDIATE"  # a lock asked for at once waits; a read lock that becomes one fails at once
    for pragma in ("journal_mode=wal", "synchronous=normal", f"busy_timeout={BUSY_TIMEOUT_MS}", "foreign_keys=on"):
        connection.execute(f"pragma {pragma}")
