"""Retention: the rule, when it removes recordings next, and when the recording of a run was removed

Revision ID: 0029
Revises: 0028
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0029"
down_revision = "0028"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("rules", sa.Column("retention", sa.JSON(none_as_null=True), nullable=True))
    op.add_column("rules", sa.Column("retention_due", sa.DateTime(timezone=True), nullable=True))
    op.add_column("run", sa.Column("recording_removed_at", sa.DateTime(timezone=True), nullable=True))


def downgrade() -> None:
    op.drop_column("run", "recording_removed_at")
    op.drop_column("rules", "retention_due")
    op.drop_column("rules", "retention")
