"""Create the tables of runs, stations, the queue and workers

Revision ID: 0001
Revises:
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    queue_state = op.create_table(
        "queue_state",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("held", sa.Boolean(), nullable=False),
        sa.Column("held_by", sa.String(length=80), nullable=True),
        sa.Column("held_at", sa.DateTime(timezone=True), nullable=True),
        sa.PrimaryKeyConstraint("id"),
    )
    op.bulk_insert(queue_state, [{"id": 1, "held": False}])
    op.create_table(
        "run",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("template", sa.String(length=80), nullable=True),
        sa.Column("plan", sa.JSON(), nullable=False),
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("code_version", sa.String(length=40), nullable=False),
        sa.Column("seed", sa.BigInteger(), nullable=False),
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
        sa.Column("reason", sa.Text(), nullable=True),
        sa.Column("trip", sa.JSON(), nullable=True),
        sa.Column("duration_s", sa.Double(), nullable=False),
        sa.Column("elapsed_s", sa.Double(), nullable=True),
        sa.Column("simulated_s", sa.Double(), nullable=True),
        sa.Column("floors_peak_mm", sa.JSON(), nullable=True),
        sa.Column("recording_sha256", sa.String(length=64), nullable=True),
        sa.Column("recording_size", sa.BigInteger(), nullable=True),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_run_digest"), ["digest"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_finished_at"), ["finished_at"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_name"), ["name"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_state"), ["state"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_submitted_at"), ["submitted_at"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_submitted_by"), ["submitted_by"], unique=False)
        batch_op.create_index(batch_op.f("ix_run_template"), ["template"], unique=False)

    op.create_table(
        "worker_heartbeat",
        sa.Column("worker", sa.String(length=80), nullable=False),
        sa.Column("seen_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("worker"),
    )
    op.create_table(
        "run_station",
        sa.Column("run_number", sa.Integer(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("name", sa.String(length=80), nullable=False),
        sa.Column("mte_mm", sa.Double(), nullable=True),
        sa.Column("rms_percent", sa.Double(), nullable=True),
        sa.Column("mti_mm2", sa.Double(), nullable=True),
        sa.Column("mee_kNm", sa.Double(), nullable=True),
        sa.Column("peak_stroke_mm", sa.Double(), nullable=True),
        sa.Column("peak_force_kN", sa.Double(), nullable=True),
        sa.ForeignKeyConstraint(["run_number"], ["run.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("run_number", "number"),
    )


def downgrade() -> None:
    op.drop_table("run_station")
    op.drop_table("worker_heartbeat")
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_run_template"))
        batch_op.drop_index(batch_op.f("ix_run_submitted_by"))
        batch_op.drop_index(batch_op.f("ix_run_submitted_at"))
        batch_op.drop_index(batch_op.f("ix_run_state"))
        batch_op.drop_index(batch_op.f("ix_run_name"))
        batch_op.drop_index(batch_op.f("ix_run_finished_at"))
        batch_op.drop_index(batch_op.f("ix_run_digest"))

    op.drop_table("run")
    op.drop_table("queue_state")
