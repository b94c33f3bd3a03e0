"""Create the table of rigs, and add the order of the queue and the retries of runs

Revision ID: 0011
Revises: 0010
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"
branch_labels = None
depends_on = None


def upgrade() -> None:
    rig = op.create_table(
        "rig",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=80), nullable=False),
        sa.Column("kind", sa.String(length=16), nullable=False),
        sa.Column("tests_at_a_time", sa.Integer(), nullable=True),
        sa.Column("actuators", sa.JSON(), nullable=False),
        sa.Column("retired", sa.Boolean(), nullable=False),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
        sa.UniqueConstraint("name"),
    )
    emulated = {"id": "emulated", "name": "Emulated laboratory", "kind": "emulated", "actuators": [], "retired": False}
    op.bulk_insert(rig, [emulated])
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.add_column(sa.Column("rig_id", sa.String(length=36), server_default="emulated", nullable=False))
        batch_op.add_column(sa.Column("retry_of", sa.String(length=36), nullable=True))
        batch_op.add_column(sa.Column("pace", sa.Double(), nullable=True))
        batch_op.add_column(sa.Column("samples", sa.BigInteger(), nullable=True))
        batch_op.add_column(sa.Column("size", sa.String(length=40), nullable=True))
        batch_op.add_column(sa.Column("beside", sa.Integer(), nullable=True))
        batch_op.add_column(sa.Column("priority", sa.Integer(), server_default="0", nullable=False))
        batch_op.add_column(sa.Column("position", sa.Double(), nullable=True))
        batch_op.add_column(sa.Column("turn", sa.String(length=36), nullable=True))
        batch_op.create_index(batch_op.f("ix_run_retry_of"), ["retry_of"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_rig_id"), ["rig_id"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_turn"), ["turn"], unique=False)
    op.execute("update run set turn = id where state = 'running'")

    with op.batch_alter_table("worker_heartbeat", schema=None) as batch_op:
        batch_op.add_column(sa.Column("tests_at_a_time", sa.Integer(), server_default="1", nullable=False))


def downgrade() -> None:
    with op.batch_alter_table("worker_heartbeat", schema=None) as batch_op:
        batch_op.drop_column("tests_at_a_time")

    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_run_turn"))
        batch_op.drop_index(batch_op.f("ix_run_rig_id"))
        batch_op.drop_index(batch_op.f("ix_run_retry_of"))
        batch_op.drop_column("turn")
        batch_op.drop_column("position")
        batch_op.drop_column("priority")
        batch_op.drop_column("beside")
        batch_op.drop_column("size")
        batch_op.drop_column("samples")
        batch_op.drop_column("pace")
        batch_op.drop_column("retry_of")
        batch_op.drop_column("rig_id")

    op.drop_table("rig")
