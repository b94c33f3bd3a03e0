"""Tables of the library of plans: versions, tags and drafts."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column, relationship

from app.db import Base


class LibraryPlan(Base):
    """A plan kept under a name in the library. Its versions are numbered from 1 and never change; `newest` is the last."""

    __tablename__ = "library_plan"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), unique=True)
    newest: Mapped[int]
    created_by: Mapped[str] = mapped_column(sa.String(80))
    created_at: Mapped[datetime]
    changed_at: Mapped[datetime] = mapped_column(index=True)
    archived_by: Mapped[str | None] = mapped_column(sa.String(80))
    archived_at: Mapped[datetime | None]
    versions: Mapped[list[PlanVersion]] = relationship(back_populates="kept", order_by="PlanVersion.number.desc()")
    tagged: Mapped[list[PlanTag]] = relationship(order_by="PlanTag.tag", cascade="all, delete-orphan", lazy="selectin")

    @property
    def tags(self) -> list[str]:
        return [one.tag for one in self.tagged]


class PlanTag(Base):
    """A tag of a plan in the library."""

    __tablename__ = "plan_tag"

    plan_number: Mapped[int] = mapped_column(sa.ForeignKey("library_plan.number", ondelete="CASCADE"), primary_key=True)
    tag: Mapped[str] = mapped_column(sa.String(40), primary_key=True, index=True)


class PlanVersion(Base):
    """One version of a plan in the library. It never changes; `name` and `test` are the plan's own."""

    __tablename__ = "plan_version"

    plan_number: Mapped[int] = mapped_column(sa.ForeignKey("library_plan.number", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True)
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    test: Mapped[str] = mapped_column(sa.String(16))
    digest: Mapped[str] = mapped_column(sa.String(64))
    code_version: Mapped[str] = mapped_column(sa.String(40))
    saved_by: Mapped[str] = mapped_column(sa.String(80))
    saved_at: Mapped[datetime]
    comment: Mapped[str] = mapped_column(sa.Text)
    kept: Mapped[LibraryPlan] = relationship(back_populates="versions")


class PlanDraft(Base):
    """A plan as someone types it, valid or not: its owner, its start, and a revision that counts the saves.

    `writer` names the page that saved last; `closed_as` says what became of a draft that is no longer open.
    """

    __tablename__ = "plan_draft"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    owner: Mapped[str] = mapped_column(sa.String(80), index=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    problems: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    revision: Mapped[int]
    writer: Mapped[str] = mapped_column(sa.String(40))
    origin_kind: Mapped[str | None] = mapped_column(sa.String(16))
    origin_id: Mapped[str | None] = mapped_column(sa.String(80), index=True)
    origin_version: Mapped[int | None]
    created_at: Mapped[datetime]
    saved_at: Mapped[datetime] = mapped_column(index=True)
    closed_as: Mapped[str | None] = mapped_column(sa.String(16))
    closed_at: Mapped[datetime | None]
