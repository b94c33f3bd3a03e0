"""Alembic's environment: migrate the database at the URL in the configuration (`attributes["url"]`)."""

from __future__ import annotations

from typing import Any, Literal

from alembic import context

from app import models
from app.db import Base, UtcDateTime, connect

assert models  # the import registers the tables with Base


def render(kind: str, item: Any, _: object) -> str | Literal[False]:
    return "sa.DateTime(timezone=True)" if isinstance(item, UtcDateTime) else False


engine = connect(context.config.attributes["url"])
with engine.connect() as connection:
    if connection.dialect.name == "sqlite":
        # SQLite alters a table by copying and dropping it. With foreign keys, the drop would delete the rows that refer to it.
        connection.connection.execute("pragma foreign_keys=off")
    context.configure(connection=connection, target_metadata=Base.metadata, render_as_batch=True, render_item=render)
    with context.begin_transaction():
        context.run_migrations()
engine.dispose()
