"""Rename the templates of Table III: the frame with the emulated laboratory replaces the shear building

Revision ID: 0012
Revises: 0011
"""

from __future__ import annotations

from alembic import op

revision = "0012"
down_revision = "0011"
branch_labels = None
depends_on = None


def _rename(before: str, after: str) -> None:
    """Rename the templates that runs state; the plans of the runs, and their digests, stay as they are."""
    op.execute(f"UPDATE run SET template = REPLACE(template, '{before}-', '{after}-') WHERE template LIKE '{before}-%'")


def upgrade() -> None:
    _rename("table3", "shear-table3")
    _rename("table4", "table3")


def downgrade() -> None:
    _rename("table3", "table4")
    _rename("shear-table3", "table3")
