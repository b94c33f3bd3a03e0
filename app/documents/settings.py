"""The table of environment variables, from the settings."""

from __future__ import annotations

from app.config import VARIABLES, Settings
from app.documents.markdown import code, table


def settings() -> str:
    """Every variable, what it sets and its default."""
    plain = Settings(worker_token="")
    rows = [
        (code(one.key), one.meaning, one.default or code(one.written(getattr(plain, name)))) for name, one in VARIABLES.items()
    ]
    return table(["variable", "sets", "default"], rows)
