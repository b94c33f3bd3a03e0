"""Tables of the rules of the laboratory, and of who drives which rig."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base


class Rules(Base):
    """The rules of the laboratory: one row. `one_driver`: only the driver of a rig starts and stops its tests.

    `approvals`: another person approves each submission; beside administrators the people named in `approvers`.
    `retention`: which recordings are removed (app/retention/schemas.py), null: none; `retention_due`: not before this time.
    """

    __tablename__ = "rules"

    id: Mapped[int] = mapped_column(primary_key=True)
    one_driver: Mapped[bool] = mapped_column(default=False, server_default=sa.false())
    approvals: Mapped[bool] = mapped_column(default=False, server_default=sa.false())
    approvers: Mapped[list[str]] = mapped_column(sa.JSON, default=list, server_default="[]")
    retention: Mapped[dict[str, Any] | None] = mapped_column(sa.JSON(none_as_null=True))
    retention_due: Mapped[datetime | None]


class Approval(Base):
    """A run or a sweep that another person approves before it queues. `digest` is that of what was submitted.

    `decision` is null while it waits, then `approved`, `rejected` or `withdrawn`.
    """

    __tablename__ = "approval"

    number: Mapped[int] = mapped_column(primary_key=True)
    about: Mapped[str] = mapped_column(sa.String(16))
    about_id: Mapped[str] = mapped_column(sa.String(36), index=True)
    digest: Mapped[str] = mapped_column(sa.String(64))
    asked_by: Mapped[str] = mapped_column(sa.String(80))
    asked_at: Mapped[datetime]
    decision: Mapped[str | None] = mapped_column(sa.String(16))
    decided_by: Mapped[str | None] = mapped_column(sa.String(80))
    decided_at: Mapped[datetime | None]
    reason: Mapped[str] = mapped_column(sa.String(200), default="")


class RigControl(Base):
    """Who drives a rig, until when unless renewed, and who asks for it. A rig that nobody ever drove has no row."""

    __tablename__ = "rig_control"

    rig_id: Mapped[str] = mapped_column(sa.String(36), primary_key=True)
    driver: Mapped[str] = mapped_column(sa.String(80), default="")
    since: Mapped[datetime]
    until: Mapped[datetime]
    asked_by: Mapped[str] = mapped_column(sa.String(80), default="")
