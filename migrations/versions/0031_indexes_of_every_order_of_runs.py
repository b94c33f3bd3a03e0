"""Give the orders of runs by number, reason and notes an index that holds all that a page needs

The index of a text holds the short texts only; a further index holds the runs with a long text: docs/decisions/0081.

Revises: 0030
"""

from __future__ import annotations

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0031"
down_revision = "0030"
branch_labels = None
depends_on = None

HIDES = ["archived", "deleted_at"]
TEXTS = ("reason", "notes")


def upgrade() -> None:
    op.create_index("ix_run_by_number", "run", ["number", *HIDES])
    for text in TEXTS:
        op.create_index(
            f"ix_run_by_{text}", "run", [text, "number", *HIDES], **_where(f"({text} IS NULL OR length({text}) <= 600)")
        )
        op.create_index(f"ix_run_long_{text}", "run", ["number"], **_where(f"length({text}) > 600"))


def downgrade() -> None:
    op.drop_index("ix_run_by_number", "run")
    for text in TEXTS:
        op.drop_index(f"ix_run_by_{text}", "run")
        op.drop_index(f"ix_run_long_{text}", "run")


def _where(condition: str) -> dict[str, Any]:
    return {"sqlite_where": sa.text(condition), "postgresql_where": sa.text(condition)}
