"""Create approvals: runs and sweeps that another person approves before they queue

Revision ID: 0028
Revises: 0027
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0028"
down_revision = "0027"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "approval",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("about", sa.String(length=16), nullable=False),
        sa.Column("about_id", sa.String(length=36), nullable=False),
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("asked_by", sa.String(length=80), nullable=False),
        sa.Column("asked_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("decision", sa.String(length=16), nullable=True),
        sa.Column("decided_by", sa.String(length=80), nullable=True),
        sa.Column("decided_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("reason", sa.String(length=200), nullable=False),
        sa.PrimaryKeyConstraint("number"),
    )
    op.create_index("ix_approval_about_id", "approval", ["about_id"])
    with op.batch_alter_table("rules", schema=None) as batch_op:
        batch_op.add_column(sa.Column("approvals", sa.Boolean(), server_default=sa.false(), nullable=False))
        batch_op.add_column(sa.Column("approvers", sa.JSON(), server_default="[]", nullable=False))
    with op.batch_alter_table("sweep", schema=None) as batch_op:
        batch_op.add_column(sa.Column("to_approve", sa.Boolean(), server_default=sa.false(), nullable=False))


def downgrade() -> None:
    op.execute("UPDATE run SET state = 'cancelled', reason = 'It was to be approved.' WHERE state = 'to approve'")
    with op.batch_alter_table("sweep", schema=None) as batch_op:
        batch_op.drop_column("to_approve")
    with op.batch_alter_table("rules", schema=None) as batch_op:
        batch_op.drop_column("approvers")
        batch_op.drop_column("approvals")
    op.drop_index("ix_approval_about_id", table_name="approval")
    op.drop_table("approval")
