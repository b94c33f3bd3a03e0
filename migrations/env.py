"""Alembic's environment: migrates the database whose URL the caller put in the configuration."""

from __future__ import annotations

from typing import Any, Literal

from alembic import context

from app import models
from app.db import Base, UtcDateTime, connect

assert models  # imported so that Base knows the tables


def render(kind: str, item: Any, _: object) -> str | Literal[False]:
    return "sa.DateTime(timezone=True)" if isinstance(item, UtcDateTime) else False


engine = connect(context.config.attributes["url"])
with engine.connect() as connection:
    context.configure(connection=connection, target_metadata=Base.metadata, render_as_batch=True, render_item=render)
    with context.begin_transaction():
        context.run_migrations()
engine.dispose()
