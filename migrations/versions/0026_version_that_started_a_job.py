"""Add the version of the program that started a job

Revision ID: 0026
Revises: 0025
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0026"
down_revision = "0025"
branch_labels = None
depends_on = None

TABLES = ("run", "diagnosis", "sweep_shard")


def upgrade() -> None:
    for table in TABLES:
        op.add_column(table, sa.Column("started_version", sa.String(length=40), nullable=True))


def downgrade() -> None:
    for table in TABLES:
        with op.batch_alter_table(table, schema=None) as batch_op:
            batch_op.drop_column("started_version")
