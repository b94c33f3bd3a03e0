"""Move the plans of runs to their own table, add what people say about runs, and index plans and measures of all runs

Revision ID: 0010
Revises: 0009
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None

BATCH = 500  # runs written together
LONGEST_LIST, LONGEST_TEXT = 32, 200
LEFT_OUT = {"schema", "name", "notes", "template", "test", "known", "sha256", "acceleration"}
STATION = (
    *("mte_mm", "rms_percent", "mti_mm2", "mee_kNm", "peak_stroke_mm", "peak_force_kN"),
    *("fei_delay_ms", "fei_amplitude", "nrms_percent", "peak_error_percent", "delay_ms", "energy_error_percent"),
)

RUN = sa.table("run", sa.column("number"), sa.column("test"), sa.column("plan", sa.JSON), sa.column("floors_peak_mm", sa.JSON))
STATIONS = sa.table("run_station", sa.column("run_number"), sa.column("number"), *(sa.column(name) for name in STATION))
PLANS = sa.table("run_plan", sa.column("run_number"), sa.column("plan", sa.JSON))
PATHS = sa.table("value_path", sa.column("id"), sa.column("path"))
VALUES = sa.table("run_value", *(sa.column(name) for name in ("path_id", "run_number", "number", "text")))


def upgrade() -> None:
    op.add_column("run", sa.Column("test", sa.String(length=16), nullable=False, server_default="hybrid"))
    op.add_column("run", sa.Column("tags", sa.Text(), nullable=False, server_default=""))
    op.add_column("run", sa.Column("notes", sa.Text(), nullable=False, server_default=""))
    op.add_column("run", sa.Column("archived", sa.Boolean(), nullable=False, server_default=sa.false()))
    op.add_column("run", sa.Column("deleted_at", sa.DateTime(timezone=True), nullable=True))
    op.create_table(
        "run_plan",
        sa.Column("run_number", sa.Integer(), sa.ForeignKey("run.number", ondelete="CASCADE"), nullable=False),
        sa.Column("plan", sa.JSON(), nullable=False),
        sa.PrimaryKeyConstraint("run_number"),
    )
    op.create_table(
        "value_path",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("path", sa.String(length=200), nullable=False),
        sa.PrimaryKeyConstraint("id"),
        sa.UniqueConstraint("path"),
    )
    op.create_table(
        "run_value",
        sa.Column("path_id", sa.Integer(), sa.ForeignKey("value_path.id"), autoincrement=False, nullable=False),
        sa.Column("run_number", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("number", sa.Double(), nullable=True),
        sa.Column("text", sa.String(length=200), nullable=True),
        sa.PrimaryKeyConstraint("path_id", "run_number"),
        sqlite_with_rowid=False,
    )
    op.create_table(
        "run_view",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("name", sa.String(length=80), nullable=False),
        sa.Column("query", sa.Text(), nullable=False),
        sa.Column("saved_by", sa.String(length=80), nullable=False),
        sa.Column("saved_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id"),
        sa.UniqueConstraint("name"),
    )
    op.execute("INSERT INTO run_plan (run_number, plan) SELECT number, plan FROM run")
    _fill(op.get_bind())
    for name in ("number", "text"):
        given = sa.text(f"{name} IS NOT NULL")
        columns = ["path_id", name, "run_number"]
        op.create_index(f"ix_run_value_{name}", "run_value", columns, sqlite_where=given, postgresql_where=given)
    op.drop_column("run", "plan")


def downgrade() -> None:
    op.add_column("run", sa.Column("plan", sa.JSON(), nullable=False, server_default="{}"))
    op.execute("UPDATE run SET plan = (SELECT plan FROM run_plan WHERE run_plan.run_number = run.number)")
    for table in ("run_view", "run_value", "value_path", "run_plan"):
        op.drop_table(table)
    for name in ("deleted_at", "archived", "notes", "tags", "test"):
        op.drop_column("run", name)


def _fill(connection: sa.Connection) -> None:
    """Write kind of test and values of all runs, a batch at a time."""
    ids: dict[str, int] = {}
    last = 0
    while True:
        query = sa.select(RUN.c.number, RUN.c.plan, RUN.c.floors_peak_mm).where(RUN.c.number > last).order_by(RUN.c.number)
        runs = connection.execute(query.limit(BATCH)).all()
        if not runs:
            return
        first, last = runs[0].number, runs[-1].number
        measured: dict[int, dict[int, dict[str, float]]] = {}
        for row in connection.execute(sa.select(STATIONS).where(STATIONS.c.run_number.between(first, last))).mappings():
            measured.setdefault(row["run_number"], {})[row["number"]] = {k: row[k] for k in STATION if row[k] is not None}
        values = []
        for run in runs:
            found = {**dict(_flat("plan", run.plan)), **dict(_measures(measured.get(run.number, {}), run.floors_peak_mm))}
            for path, value in found.items():
                if path not in ids:
                    ids[path] = connection.scalar(sa.insert(PATHS).values(path=path).returning(PATHS.c.id))
                text = value[:LONGEST_TEXT] if isinstance(value, str) else None
                number = None if isinstance(value, str) else float(value)
                values.append({"path_id": ids[path], "run_number": run.number, "number": number, "text": text})
        if values:
            connection.execute(sa.insert(VALUES), sorted(values, key=lambda row: (row["path_id"], row["run_number"])))
        for test in {run.plan.get("test", "hybrid") for run in runs} - {"hybrid"}:
            numbers = [run.number for run in runs if run.plan.get("test") == test]
            connection.execute(sa.update(RUN).where(RUN.c.number.in_(numbers)).values(test=test))


def _measures(stations: dict[int, dict[str, float]], floors: list[float | None] | None) -> Iterator[tuple[str, float]]:
    for key in STATION:
        found = {number: measures[key] for number, measures in stations.items() if key in measures}
        yield from ((f"{key}:{number}", value) for number, value in found.items())
        if found:
            yield f"{key}:max", max(found.values(), key=abs)
    peaks = {number: peak for number, peak in enumerate(floors or [], start=1) if peak is not None}
    yield from ((f"floors_peak_mm:{number}", peak) for number, peak in peaks.items())
    if peaks:
        yield "floors_peak_mm:max", max(peaks.values(), key=abs)


def _flat(path: str, value: Any) -> Iterator[tuple[str, float | str]]:
    if isinstance(value, dict):
        for name, inner in value.items():
            if name not in LEFT_OUT:
                yield from _flat(f"{path}.{name}", inner)
    elif isinstance(value, list):
        if len(value) <= LONGEST_LIST:
            for index, inner in enumerate(value):
                if not isinstance(inner, list):
                    yield from _flat(f"{path}.{index}", inner)
    elif value is not None and len(path) <= LONGEST_TEXT:
        yield path, "yes" if value is True else "no" if value is False else value
