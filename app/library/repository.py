"""SQL of the plans in the library, their versions, tags and runs. Never commits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import sqlalchemy as sa
from sqlalchemy.orm import Session, undefer

from app.db import locked
from app.models import LibraryPlan, PlanDraft, PlanTag, PlanVersion, Run

SORTS: dict[str, Any] = {
    "name": sa.func.lower(LibraryPlan.name),
    "changed_at": LibraryPlan.changed_at,
    "versions": LibraryPlan.newest,
    "saved_by": sa.func.lower(PlanVersion.saved_by),
}


@dataclass(frozen=True, slots=True)
class Wanted:
    """Filter, order and page of a list of plans. `text` is looked for in names, tags and comments."""

    text: str = ""
    tag: str = ""
    saved_by: str = ""
    archived: bool = False
    sort: str = "changed_at"
    descending: bool = True
    limit: int = 50
    offset: int = 0


class LibraryRows:
    """SQL of plans in the library. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def add(self, plan: LibraryPlan) -> None:
        self.session.add(plan)
        self.session.flush()

    def add_version(self, plan: LibraryPlan, version: PlanVersion) -> None:
        version.plan_number = plan.number
        self.session.add(version)
        self.session.flush()

    def get(self, plan_id: str) -> LibraryPlan | None:
        return self.session.scalar(sa.select(LibraryPlan).where(LibraryPlan.id == plan_id))

    def locked(self, plan_id: str) -> LibraryPlan | None:
        """The plan as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, LibraryPlan, id=plan_id)

    def named(self, name: str) -> LibraryPlan | None:
        return self.session.scalar(sa.select(LibraryPlan).where(LibraryPlan.name == name))

    def taken(self, name: str) -> set[str]:
        """The names in use that start with `name`."""
        return set(self.session.scalars(sa.select(LibraryPlan.name).where(LibraryPlan.name.startswith(name, autoescape=True))))

    def version(self, plan: LibraryPlan, number: int) -> PlanVersion | None:
        """A version with its plan."""
        found = sa.select(PlanVersion).where(PlanVersion.plan_number == plan.number, PlanVersion.number == number)
        return self.session.scalar(found.options(undefer(PlanVersion.plan)))

    def with_digest(self, plan: LibraryPlan, digest: str) -> list[PlanVersion]:
        """The versions that compute the same, newest first, with their plans."""
        found = sa.select(PlanVersion).where(PlanVersion.plan_number == plan.number, PlanVersion.digest == digest)
        return list(self.session.scalars(found.order_by(PlanVersion.number.desc()).options(undefer(PlanVersion.plan))))

    def versions(self, plan: LibraryPlan) -> list[PlanVersion]:
        """All versions, newest first."""
        found = sa.select(PlanVersion).where(PlanVersion.plan_number == plan.number)
        return list(self.session.scalars(found.order_by(PlanVersion.number.desc())))

    def listed(self, wanted: Wanted) -> tuple[list[tuple[LibraryPlan, PlanVersion]], int]:
        """A page of plans with their newest versions, and the total number."""
        newest = (PlanVersion.plan_number == LibraryPlan.number) & (PlanVersion.number == LibraryPlan.newest)
        query = sa.select(LibraryPlan, PlanVersion).join(PlanVersion, newest).where(*self._filter(wanted))
        order = SORTS[wanted.sort].desc() if wanted.descending else SORTS[wanted.sort].asc()
        total = self.session.scalar(sa.select(sa.func.count()).select_from(query.subquery())) or 0
        found = self.session.execute(query.order_by(order, LibraryPlan.number.desc()).limit(wanted.limit).offset(wanted.offset))
        return [(plan, version) for plan, version in found], total

    def _filter(self, wanted: Wanted) -> list[sa.ColumnElement[bool]]:
        found: list[sa.ColumnElement[bool]] = [
            LibraryPlan.archived_at.is_not(None) if wanted.archived else LibraryPlan.archived_at.is_(None)
        ]
        if wanted.text:
            commented = LibraryPlan.versions.any(PlanVersion.comment.icontains(wanted.text, autoescape=True))
            tagged = LibraryPlan.tagged.any(PlanTag.tag.icontains(wanted.text, autoescape=True))
            found.append(LibraryPlan.name.icontains(wanted.text, autoescape=True) | tagged | commented)
        if wanted.tag:
            found.append(LibraryPlan.tagged.any(PlanTag.tag == wanted.tag))
        if wanted.saved_by:
            found.append(PlanVersion.saved_by.icontains(wanted.saved_by, autoescape=True))
        return found

    def tags(self) -> list[tuple[str, int]]:
        """Every tag of a plan that is not archived, and its number of plans."""
        count = sa.func.count()
        query = sa.select(PlanTag.tag, count).join(LibraryPlan, LibraryPlan.number == PlanTag.plan_number)
        query = query.where(LibraryPlan.archived_at.is_(None)).group_by(PlanTag.tag).order_by(PlanTag.tag)
        return [(tag, number) for tag, number in self.session.execute(query)]

    def run_counts(self, ids: Sequence[str]) -> dict[tuple[str, int], int]:
        """Number of runs of each plan and version."""
        of_plans = Run.library_id.in_(ids) & Run.deleted_at.is_(None)
        query = sa.select(Run.library_id, Run.library_version, sa.func.count()).where(of_plans)
        found = self.session.execute(query.group_by(Run.library_id, Run.library_version))
        return {(cast(str, plan), version or 0): number for plan, version, number in found}

    def draft_counts(self, ids: Sequence[str]) -> dict[str, int]:
        """Number of open drafts that started from each plan."""
        query = sa.select(PlanDraft.origin_id, sa.func.count()).where(
            PlanDraft.origin_kind == "version", PlanDraft.origin_id.in_(ids), PlanDraft.closed_at.is_(None)
        )
        return {cast(str, plan): number for plan, number in self.session.execute(query.group_by(PlanDraft.origin_id))}

    def runs(self, plan: LibraryPlan, limit: int, offset: int) -> list[tuple[Run, str | None]]:
        """The newest runs that were queued from a plan, each with the digest of its version."""
        version = (PlanVersion.plan_number == plan.number) & (PlanVersion.number == Run.library_version)
        query = sa.select(Run, PlanVersion.digest).outerjoin(PlanVersion, version)
        query = query.where(Run.library_id == plan.id, Run.deleted_at.is_(None))
        found = self.session.execute(query.order_by(Run.number.desc()).limit(limit).offset(offset))
        return [(run, digest) for run, digest in found]

    def run(self, run_id: str) -> Run | None:
        return self.session.scalar(sa.select(Run).where(Run.id == run_id))
