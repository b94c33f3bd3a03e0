"""Create the rules of the laboratory, and who drives which rig

Revision ID: 0027
Revises: 0026
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0027"
down_revision = "0026"
branch_labels = None
depends_on = None


def upgrade() -> None:
    rules = op.create_table(
        "rules",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("one_driver", sa.Boolean(), server_default=sa.false(), nullable=False),
        sa.PrimaryKeyConstraint("id"),
    )
    op.bulk_insert(rules, [{"id": 1}])
    op.create_table(
        "rig_control",
        sa.Column("rig_id", sa.String(length=36), nullable=False),
        sa.Column("driver", sa.String(length=80), nullable=False),
        sa.Column("since", sa.DateTime(timezone=True), nullable=False),
        sa.Column("until", sa.DateTime(timezone=True), nullable=False),
        sa.Column("asked_by", sa.String(length=80), nullable=False),
        sa.PrimaryKeyConstraint("rig_id"),
    )


def downgrade() -> None:
    op.drop_table("rig_control")
    op.drop_table("rules")
