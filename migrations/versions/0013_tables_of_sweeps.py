"""Create the tables of sweeps, their shards and their results

Revision ID: 0013
Revises: 0012
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "sweep",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("definition", sa.JSON(), nullable=False),
        sa.Column("columns", sa.JSON(), nullable=False),
        sa.Column("method", sa.String(length=24), nullable=False),
        sa.Column("points", sa.Integer(), nullable=False),
        sa.Column("cost", sa.String(length=120), nullable=False),
        sa.Column("code_version", sa.String(length=40), nullable=False),
        sa.Column("submitted_by", sa.String(length=80), nullable=False),
        sa.Column("submitted_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("cancelled_by", sa.String(length=80), nullable=True),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    with op.batch_alter_table("sweep", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_sweep_cost"), ["cost"], unique=False)
        batch_op.create_index(batch_op.f("ix_sweep_submitted_at"), ["submitted_at"], unique=False)

    op.create_table(
        "sweep_part",
        sa.Column("sweep_number", sa.Integer(), nullable=False),
        sa.Column("first", sa.Integer(), nullable=False),
        sa.Column("count", sa.Integer(), nullable=False),
        sa.Column("values", sa.LargeBinary(), nullable=False),
        sa.Column("reasons", sa.JSON(), nullable=False),
        sa.Column("tripped", sa.Integer(), nullable=False),
        sa.Column("invalid", sa.Integer(), nullable=False),
        sa.Column("failed", sa.Integer(), nullable=False),
        sa.Column("elapsed_s", sa.Double(), nullable=False),
        sa.Column("simulated_s", sa.Double(), nullable=False),
        sa.Column("stored_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(["sweep_number"], ["sweep.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("sweep_number", "first"),
    )
    with op.batch_alter_table("sweep_part", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_sweep_part_stored_at"), ["stored_at"], unique=False)

    op.create_table(
        "sweep_shard",
        sa.Column("sweep_number", sa.Integer(), nullable=False),
        sa.Column("first", sa.Integer(), nullable=False),
        sa.Column("count", sa.Integer(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column(
            "state",
            sa.Enum(
                "queued", "running", "completed", "tripped", "cancelled", "failed", name="state", native_enum=False, length=16
            ),
            nullable=False,
        ),
        sa.Column("submitted_by", sa.String(length=80), nullable=False),
        sa.Column("submitted_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("started_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("finished_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("cancel_requested_by", sa.String(length=80), nullable=True),
        sa.Column("attempt", sa.Integer(), nullable=False),
        sa.Column("worker", sa.String(length=80), nullable=True),
        sa.Column("doing", sa.String(length=200), nullable=False),
        sa.Column("share", sa.Double(), nullable=False),
        sa.Column("reason", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(["sweep_number"], ["sweep.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    with op.batch_alter_table("sweep_shard", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_sweep_shard_state"), ["state"], unique=False)
        batch_op.create_index(batch_op.f("ix_sweep_shard_sweep_number"), ["sweep_number"], unique=False)


def downgrade() -> None:
    with op.batch_alter_table("sweep_shard", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_sweep_shard_sweep_number"))
        batch_op.drop_index(batch_op.f("ix_sweep_shard_state"))

    op.drop_table("sweep_shard")
    with op.batch_alter_table("sweep_part", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_sweep_part_stored_at"))

    op.drop_table("sweep_part")
    with op.batch_alter_table("sweep", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_sweep_submitted_at"))
        batch_op.drop_index(batch_op.f("ix_sweep_cost"))

    op.drop_table("sweep")
