"""`make migration MESSAGE="..."`: write a migration from the newest revision to the present models."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from alembic import command
from alembic.operations import ops
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory

from app import db


def write(message: str, folder: Path = db.MIGRATIONS) -> Path | None:
    """Write the migration into `folder`; returns its path, or None if the models have not changed."""
    with tempfile.TemporaryDirectory() as data:
        config = db.alembic_config(f"sqlite:///{data}/newest.sqlite", folder)
        config.set_main_option("file_template", "%%(rev)s_%%(slug)s")
        command.upgrade(config, "head")
        number = 1 + max(int(one.revision) for one in ScriptDirectory.from_config(config).walk_revisions())
        written = command.revision(
            config, message, autogenerate=True, rev_id=f"{number:04d}", process_revision_directives=_leave_out_empty
        )
    return Path(written.path) if written and not isinstance(written, list) else None


def _leave_out_empty(_: MigrationContext, __: object, directives: list[ops.MigrationScript]) -> None:
    if all(upgrade.is_empty() for upgrade in directives[0].upgrade_ops_list):
        directives.clear()


if __name__ == "__main__":
    given = argparse.ArgumentParser(description=__doc__)
    given.add_argument("message", help="the change in a few words")
    path = write(given.parse_args().message)
    done = f"{path}: check the migration, then add it to the commit."
    print(done if path else "The models have not changed; no migration was written.")
