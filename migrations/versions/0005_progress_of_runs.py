"""Add the progress of a run: the present step and the share done, as for every kind of job

Revision ID: 0005
Revises: 0004
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("run", sa.Column("doing", sa.String(length=200), nullable=False, server_default=""))
    op.add_column("run", sa.Column("share", sa.Double(), nullable=False, server_default="0"))


def downgrade() -> None:
    op.drop_column("run", "share")
    op.drop_column("run", "doing")
