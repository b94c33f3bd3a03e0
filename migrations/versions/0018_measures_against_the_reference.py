"""Add the measures against the reference

Revision ID: 0018
Revises: 0017
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0018"
down_revision = "0017"
branch_labels = None
depends_on = None


def upgrade() -> None:
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.add_column(sa.Column("floors_reference_rms_percent", sa.JSON(), nullable=True))
        batch_op.add_column(sa.Column("floors_reference_peak_percent", sa.JSON(), nullable=True))

    with op.batch_alter_table("run_station", schema=None) as batch_op:
        batch_op.add_column(sa.Column("reference_rms_percent", sa.Double(), nullable=True))
        batch_op.add_column(sa.Column("reference_peak_percent", sa.Double(), nullable=True))


def downgrade() -> None:
    with op.batch_alter_table("run_station", schema=None) as batch_op:
        batch_op.drop_column("reference_peak_percent")
        batch_op.drop_column("reference_rms_percent")

    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.drop_column("floors_reference_peak_percent")
        batch_op.drop_column("floors_reference_rms_percent")
