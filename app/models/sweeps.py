"""Tables of sweeps: shards, which processes execute, and parts, which hold results."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column, relationship

from app.db import Base
from app.jobs.tables import Job


class Sweep(Base):
    """Many tests that differ in chosen fields of one plan. `columns` declare the numbers of `SweepPart.values`."""

    __tablename__ = "sweep"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    definition: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    columns: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON, deferred=True)
    method: Mapped[str] = mapped_column(sa.String(24))
    points: Mapped[int]
    cost: Mapped[str] = mapped_column(sa.String(120), index=True)
    code_version: Mapped[str] = mapped_column(sa.String(40))
    submitted_by: Mapped[str] = mapped_column(sa.String(80))
    submitted_at: Mapped[datetime] = mapped_column(index=True)
    cancelled_by: Mapped[str | None] = mapped_column(sa.String(80))
    to_approve: Mapped[bool] = mapped_column(default=False, server_default=sa.false())


class SweepShard(Job, Base):
    """Consecutive points of a sweep, from `first` (the first point of a sweep is 0), which one process executes."""

    __tablename__ = "sweep_shard"

    sweep_number: Mapped[int] = mapped_column(sa.ForeignKey("sweep.number", ondelete="CASCADE"), index=True)
    first: Mapped[int]
    count: Mapped[int]
    sweep: Mapped[Sweep] = relationship()


class SweepPart(Base):
    """Results of consecutive points of a sweep, stored once: a row of little-endian float64 numbers for each point.

    `reasons` has the reason of each point that did not complete, by its place in the part. The numbers of points that tripped,
    are invalid or failed, and the sums of computing time and simulated time (s), are stored to be counted without the values.
    `sha256` is the checksum (hex) of `values`; null: an earlier version stored none.
    """

    __tablename__ = "sweep_part"

    sweep_number: Mapped[int] = mapped_column(sa.ForeignKey("sweep.number", ondelete="CASCADE"), primary_key=True)
    first: Mapped[int] = mapped_column(primary_key=True)
    count: Mapped[int]
    values: Mapped[bytes] = mapped_column(sa.LargeBinary, deferred=True)
    reasons: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    tripped: Mapped[int]
    invalid: Mapped[int]
    failed: Mapped[int]
    elapsed_s: Mapped[float]
    simulated_s: Mapped[float]
    stored_at: Mapped[datetime] = mapped_column(index=True)
    sha256: Mapped[str | None] = mapped_column(sa.String(64))
