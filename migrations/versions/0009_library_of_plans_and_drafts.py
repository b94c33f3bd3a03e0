"""Create the tables of the library of plans and of drafts; runs name the version that they were queued from

Revision ID: 0009
Revises: 0008
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0009"
down_revision = "0008"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "library_plan",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("newest", sa.Integer(), nullable=False),
        sa.Column("created_by", sa.String(length=80), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("changed_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("archived_by", sa.String(length=80), nullable=True),
        sa.Column("archived_at", sa.DateTime(timezone=True), nullable=True),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
        sa.UniqueConstraint("name"),
    )
    with op.batch_alter_table("library_plan", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_library_plan_changed_at"), ["changed_at"], unique=False)

    op.create_table(
        "plan_draft",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("owner", sa.String(length=80), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("plan", sa.JSON(), nullable=False),
        sa.Column("problems", sa.JSON(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.Column("writer", sa.String(length=40), nullable=False),
        sa.Column("origin_kind", sa.String(length=16), nullable=True),
        sa.Column("origin_id", sa.String(length=80), nullable=True),
        sa.Column("origin_version", sa.Integer(), nullable=True),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("saved_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("closed_as", sa.String(length=16), nullable=True),
        sa.Column("closed_at", sa.DateTime(timezone=True), nullable=True),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    with op.batch_alter_table("plan_draft", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_plan_draft_origin_id"), ["origin_id"], unique=False)
        batch_op.create_index(batch_op.f("ix_plan_draft_owner"), ["owner"], unique=False)
        batch_op.create_index(batch_op.f("ix_plan_draft_saved_at"), ["saved_at"], unique=False)

    op.create_table(
        "plan_tag",
        sa.Column("plan_number", sa.Integer(), nullable=False),
        sa.Column("tag", sa.String(length=40), nullable=False),
        sa.ForeignKeyConstraint(["plan_number"], ["library_plan.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("plan_number", "tag"),
    )
    with op.batch_alter_table("plan_tag", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_plan_tag_tag"), ["tag"], unique=False)

    op.create_table(
        "plan_version",
        sa.Column("plan_number", sa.Integer(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("plan", sa.JSON(), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("test", sa.String(length=16), nullable=False),
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("code_version", sa.String(length=40), nullable=False),
        sa.Column("saved_by", sa.String(length=80), nullable=False),
        sa.Column("saved_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("comment", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["plan_number"], ["library_plan.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("plan_number", "number"),
    )
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.add_column(sa.Column("library_id", sa.String(length=36), nullable=True))
        batch_op.add_column(sa.Column("library_version", sa.Integer(), nullable=True))
        batch_op.create_index(batch_op.f("ix_run_library_id"), ["library_id"], unique=False)


def downgrade() -> None:
    with op.batch_alter_table("run", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_run_library_id"))
        batch_op.drop_column("library_version")
        batch_op.drop_column("library_id")

    op.drop_table("plan_version")
    with op.batch_alter_table("plan_tag", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_plan_tag_tag"))

    op.drop_table("plan_tag")
    with op.batch_alter_table("plan_draft", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_plan_draft_saved_at"))
        batch_op.drop_index(batch_op.f("ix_plan_draft_owner"))
        batch_op.drop_index(batch_op.f("ix_plan_draft_origin_id"))

    op.drop_table("plan_draft")
    with op.batch_alter_table("library_plan", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_library_plan_changed_at"))

    op.drop_table("library_plan")
