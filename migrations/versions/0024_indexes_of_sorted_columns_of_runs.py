"""Give every column by which a list of runs sorts an index that holds all that a page needs

Each holds the column, the number of the run, and what hides a run: docs/decisions/0073. They replace the indexes of one column.

Revises: 0023
"""

from __future__ import annotations

from alembic import op

revision = "0024"
down_revision = "0023"
branch_labels = None
depends_on = None

SORTED = (
    *("state", "name", "tags", "test", "template", "submitted_by", "submitted_at", "started_at", "finished_at"),
    *("duration_s", "simulated_s", "elapsed_s", "attempt", "worker", "seed", "digest", "code_version"),
    *("recording_size", "input_energy_kNm"),
)
SINGLE = ("digest", "finished_at", "name", "submitted_at", "submitted_by", "template")


def upgrade() -> None:
    for column in SINGLE:
        op.drop_index(f"ix_run_{column}", "run")
    for column in SORTED:
        op.create_index(f"ix_run_by_{column}", "run", list(dict.fromkeys([column, "number", "archived", "deleted_at"])))


def downgrade() -> None:
    for column in SORTED:
        op.drop_index(f"ix_run_by_{column}", "run")
    for column in SINGLE:
        op.create_index(f"ix_run_{column}", "run", [column])
