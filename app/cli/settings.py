"""Settings of a command. An option takes precedence over its RTHS_* variable, and the variable over the default."""

from __future__ import annotations

import os
import secrets
from argparse import Namespace
from pathlib import Path
from typing import Any

from app import private
from app.config import Settings, from_environment, variable
from rths_engine.foundation.errors import Issue, RthsError

PORTS = range(1, 65_536)


def settings(given: Namespace, **more: Any) -> Settings:
    """The settings of a command. Raises RthsError for values that are out of range."""
    names = ("data", "host", "port", "log_format", "log_level", "tls_certificate", "tls_key")
    options = {name: getattr(given, name, None) for name in names}
    found = from_environment(**options, worker_concurrency=getattr(given, "workers", None), **more)
    if found.port not in PORTS:
        raise RthsError(Issue("port", f"needs {PORTS[0]} to {PORTS[-1]}", found.port))
    if found.worker_concurrency < 1:
        raise RthsError(Issue("workers", "needs a value >= 1", found.worker_concurrency))
    return found


def stored(given: Namespace, **more: Any) -> Settings:
    """The settings of a command, with the worker token. Creates the data folder and checks that the database answers."""
    found = settings(given, **more)
    try:
        found.prepared()
        token = variable("RTHS_WORKER_TOKEN") or _kept_token(found.data / "worker-token")
    except OSError as error:
        fix = "choose another folder with --data or RTHS_DATA"
        raise RthsError(Issue("data folder", f"can't be used: {error.strerror}", str(found.data), fix)) from None
    with private.writing():
        _check_database(found.url)
    return settings(given, worker_token=token, **more)


def _check_database(url: str) -> None:
    import sqlalchemy as sa

    from app.db import connect

    try:
        engine = connect(url)
        with engine.connect():
            pass
        engine.dispose()
    except sa.exc.SQLAlchemyError as error:
        problem = f"can't be opened: {str(getattr(error, 'orig', error)).splitlines()[0]}"
        raise RthsError(Issue("database", problem, fix="correct RTHS_DATABASE_URL, or unset it to use SQLite")) from None


def _kept_token(path: Path) -> str:
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return path.read_text()
    with os.fdopen(descriptor, "w") as file:
        token = secrets.token_urlsafe(24)
        file.write(token)
    return token
