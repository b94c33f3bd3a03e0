"""Create the tables of webhooks, and give waiting runs their pace

Revision ID: 0015
Revises: 0014
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0015"
down_revision = "0014"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "webhook",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("id", sa.String(length=36), nullable=False),
        sa.Column("url", sa.Text(), nullable=False),
        sa.Column("kinds", sa.JSON(), nullable=False),
        sa.Column("secret", sa.String(length=200), nullable=False),
        sa.Column("enabled", sa.Boolean(), nullable=False),
        sa.Column("added_by", sa.String(length=80), nullable=False),
        sa.Column("added_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("number"),
        sa.UniqueConstraint("id"),
    )
    op.create_table(
        "webhook_delivery",
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("webhook_number", sa.Integer(), nullable=False),
        sa.Column("event_number", sa.Integer(), nullable=True),
        sa.Column("state", sa.String(length=16), nullable=False),
        sa.Column("attempts", sa.Integer(), nullable=False),
        sa.Column("next_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("last_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("status", sa.Integer(), nullable=True),
        sa.Column("problem", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(
            ["event_number"],
            ["event.number"],
        ),
        sa.ForeignKeyConstraint(["webhook_number"], ["webhook.number"], ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("number"),
    )
    with op.batch_alter_table("webhook_delivery", schema=None) as batch_op:
        batch_op.create_index(batch_op.f("ix_webhook_delivery_state"), ["state"], unique=False)
        batch_op.create_index(batch_op.f("ix_webhook_delivery_webhook_number"), ["webhook_number"], unique=False)
    _give_paces()


def _give_paces() -> None:
    """The pace of runs that wait or run, from their plans; later runs are stored with it."""
    runs = sa.table("run", sa.column("number"), sa.column("state"), sa.column("pace"))
    plans = sa.table("run_plan", sa.column("run_number"), sa.column("plan", sa.JSON()))
    waiting = sa.select(runs.c.number, plans.c.plan).join(plans, plans.c.run_number == runs.c.number)
    connection = op.get_bind()
    for number, plan in connection.execute(waiting.where(runs.c.state.in_(["queued", "running"]))).all():
        pace = plan.get("pace", {})
        if pace.get("kind") == "real_time":
            connection.execute(sa.update(runs).where(runs.c.number == number).values(pace=pace.get("factor", 1.0)))


def downgrade() -> None:
    with op.batch_alter_table("webhook_delivery", schema=None) as batch_op:
        batch_op.drop_index(batch_op.f("ix_webhook_delivery_webhook_number"))
        batch_op.drop_index(batch_op.f("ix_webhook_delivery_state"))

    op.drop_table("webhook_delivery")
    op.drop_table("webhook")
