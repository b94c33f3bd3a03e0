"""Database connection, sessions, migration, and the base of every table."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ClassVar, Literal

import sqlalchemy as sa
from alembic import command
from alembic.config import Config
from sqlalchemy.orm import DeclarativeBase, Session, sessionmaker

MIGRATIONS = Path(__file__).parent.parent / "migrations"
BUSY_TIMEOUT_MS = 30_000


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


def connect(url: str) -> sa.Engine:
    """The database engine for a URL. Connections to SQLite use write-ahead logging, foreign keys and a busy timeout."""
    engine = sa.create_engine(url.replace("postgresql:", "postgresql+psycopg:", 1), pool_pre_ping=True)
    if engine.dialect.name == "sqlite":
        sa.event.listen(engine, "connect", _prepare_sqlite)
    return engine


def sessions(engine: sa.Engine) -> sessionmaker[Session]:
    """The factory of sessions; their rows stay readable after a commit."""
    return sessionmaker(engine, expire_on_commit=False)


@contextmanager
def unit_of_work(maker: sessionmaker[Session]) -> Iterator[Session]:
    """One session that commits once at the end, or rolls everything back."""
    with maker() as session, session.begin():
        yield session


def afterwards(session: Session, event: Literal["after_commit", "after_rollback"], action: Callable[[], Any]) -> None:
    """Do `action` when the transaction has ended with `event`, so that changes of files follow the changes of rows."""
    sa.event.listen(session, event, lambda _: action(), once=True)


def migrate(url: str) -> None:
    """Bring the database to the newest schema."""
    command.upgrade(alembic_config(url), "head")


def alembic_config(url: str, folder: Path | None = None) -> Config:
    """Alembic's configuration for the database at `url`, with the migrations in `folder` (default: MIGRATIONS)."""
    config = Config()
    config.set_main_option("script_location", str(folder or MIGRATIONS).replace("%", "%%"))
    config.attributes["url"] = url
    return config


def _prepare_sqlite(connection: Any, _: Any) -> None:
    for pragma in ("journal_mode=wal", "synchronous=normal", f"busy_timeout={BUSY_TIMEOUT_MS}", "foreign_keys=on"):
        connection.execute(f"pragma {pragma}")
