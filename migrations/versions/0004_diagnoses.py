"""Create the tables of diagnoses and of the recordings that they read

Revision ID: 0004
Revises: 0003
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "diagnosis",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("plan", sa.JSON(), nullable=False),
        sa.Column("level", sa.Double(), nullable=False),
        sa.Column("code_version", sa.String(length=40), nullable=False),
        sa.Column("state", sa.String(length=16), nullable=False),
        sa.Column("submitted_by", sa.String(length=80), nullable=False),
        sa.Column("submitted_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("started_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("finished_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("cancel_requested_by", sa.String(length=80), nullable=True),
        sa.Column("attempt", sa.Integer(), nullable=False),
        sa.Column("worker", sa.String(length=80), nullable=True),
        sa.Column("reason", sa.Text(), nullable=True),
        sa.Column("doing", sa.String(length=200), nullable=False),
        sa.Column("share", sa.Double(), nullable=False),
        sa.Column("found", sa.String(length=24), nullable=True),
        sa.Column("sentence", sa.Text(), nullable=True),
        sa.Column("verdict", sa.JSON(), nullable=True),
        sa.Column("pictures", sa.JSON(), nullable=True),
        sa.Column("before_id", sa.String(length=36), nullable=True),
        sa.Column("after_id", sa.String(length=36), nullable=True),
        sa.ForeignKeyConstraint(["before_id"], ["run.id"]),
        sa.ForeignKeyConstraint(["after_id"], ["run.id"]),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    op.create_index("ix_diagnosis_state", "diagnosis", ["state"])
    op.create_table(
        "diagnosis_input",
        sa.Column("diagnosis_number", sa.Integer(), nullable=False),
        sa.Column("place", sa.Integer(), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("recording_id", sa.String(length=36), nullable=True),
        sa.Column("run_id", sa.String(length=36), nullable=True),
        sa.ForeignKeyConstraint(["diagnosis_number"], ["diagnosis.number"], ondelete="CASCADE"),
        sa.ForeignKeyConstraint(["recording_id"], ["measured_recording.id"]),
        sa.ForeignKeyConstraint(["run_id"], ["run.id"]),
        sa.PrimaryKeyConstraint("diagnosis_number", "place"),
    )
    op.create_index("ix_diagnosis_input_recording_id", "diagnosis_input", ["recording_id"])


def downgrade() -> None:
    op.drop_table("diagnosis_input")
    op.drop_table("diagnosis")
