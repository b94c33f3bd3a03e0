"""Commands in the audit log: a command that changed the data folder is recorded after it has succeeded."""

from __future__ import annotations

import getpass
from argparse import Namespace
from typing import Any

from app import db
from app.audit.given import SECRET
from app.audit.log import Acting, AuditLog
from app.cli.settings import stored

OF_PARSER = {"function", "command", "action", "recorded", "private"}


def record(given: Namespace) -> None:
    """Record a command with its options; options whose name speaks of a secret are left out."""
    settings = stored(given)
    engine = db.connect(settings.url)
    try:
        with db.unit_of_work(db.sessions(engine)) as session:
            AuditLog(session).add(Acting(user(), "", "command line"), name(given), details=_options(given))
    finally:
        engine.dispose()


def user() -> str:
    """The user of this computer; empty where it has no name, as in some containers."""
    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return ""


def name(given: Namespace) -> str:
    """A command as the log names it: `rths library save`."""
    return " ".join(["rths", given.command, *([given.action] if isinstance(getattr(given, "action", None), str) else [])])


def _options(given: Namespace) -> dict[str, Any]:
    found = {one: value for one, value in vars(given).items() if one not in OF_PARSER and value not in (None, "", [], False)}
    plain = {one: value for one, value in found.items() if not SECRET.search(one)}
    return {one: value if isinstance(value, bool | int) else str(value) for one, value in plain.items()}
