"""Names of accounts: one space between words, so that no two names look equal

Revision ID: 0030
Revises: 0029
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0030"
down_revision = "0029"
branch_labels = None
depends_on = None

ACCOUNT = sa.table("account", sa.column("id"), sa.column("name"), sa.column("key"))
LONGEST = 80  # characters of a name


def upgrade() -> None:
    """Tidy the names with more than one space; where the tidy name is taken, a number behind it tells the two apart."""
    connection = op.get_bind()
    rows = connection.execute(sa.select(ACCOUNT.c.id, ACCOUNT.c.name, ACCOUNT.c.key).order_by(ACCOUNT.c.key)).all()
    taken = {row.key for row in rows}
    for row in rows:
        key = " ".join(row.key.split())
        if key == row.key:
            continue
        name, number = " ".join(row.name.split()), 2
        free, shown = key, name
        while free in taken:
            free, shown = f"{key} ({number})", f"{name[: LONGEST - 6]} ({number})"
            number += 1
        taken.add(free)
        connection.execute(sa.update(ACCOUNT).where(ACCOUNT.c.id == row.id).values(name=shown, key=free))


def downgrade() -> None:
    """The names are valid in the earlier version too."""
