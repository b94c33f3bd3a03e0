"""Add the measures that the paper does not have, and the input energy of a run

Revision ID: 0002
Revises: 0001
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None

STATION = ("fei_delay_ms", "fei_amplitude", "nrms_percent", "peak_error_percent", "delay_ms", "energy_error_percent")


def upgrade() -> None:
    op.add_column("run", sa.Column("input_energy_kNm", sa.Double(), nullable=True))
    for name in STATION:
        op.add_column("run_station", sa.Column(name, sa.Double(), nullable=True))


def downgrade() -> None:
    for name in STATION:
        op.drop_column("run_station", name)
    op.drop_column("run", "input_energy_kNm")
