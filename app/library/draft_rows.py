"""SQL of drafts. Never commits."""

from __future__ import annotations

from typing import Any, cast

import sqlalchemy as sa
from sqlalchemy.orm import Session, undefer

from app.models import LibraryPlan, PlanDraft, Run

MOST = 100  # listed


class DraftRows:
    """SQL of drafts. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def add(self, draft: PlanDraft) -> None:
        self.session.add(draft)
        self.session.flush()

    def get(self, draft_id: str) -> PlanDraft | None:
        """The draft as it is now, with its plan."""
        found = sa.select(PlanDraft).where(PlanDraft.id == draft_id).options(undefer(PlanDraft.plan))
        return self.session.scalar(found.execution_options(populate_existing=True))

    def listed(self, owner: str | None, closed: bool, origin_id: str | None) -> list[PlanDraft]:
        """Drafts that are open, or closed, last saved first: of one owner, and from one origin, where these are given."""
        query = sa.select(PlanDraft).where(PlanDraft.closed_at.is_not(None) if closed else PlanDraft.closed_at.is_(None))
        if owner is not None:
            query = query.where(PlanDraft.owner == owner)
        if origin_id is not None:
            query = query.where(PlanDraft.origin_id == origin_id)
        return list(self.session.scalars(query.order_by(PlanDraft.saved_at.desc(), PlanDraft.number.desc()).limit(MOST)))

    def change(self, draft_id: str, revision: int, writer: str, **values: Any) -> bool:
        """Change an open draft of this revision, or one that this writer saved last. False if there is no such draft.

        The writer counts too because a page that is left cannot read the answer to its last save.
        """
        same = PlanDraft.revision == revision
        if writer:
            same |= PlanDraft.writer == writer
        where = (PlanDraft.id == draft_id) & PlanDraft.closed_at.is_(None) & same
        change = sa.update(PlanDraft).where(where).values(revision=PlanDraft.revision + 1, writer=writer, **values)
        done = self.session.execute(change, execution_options={"synchronize_session": False})
        return bool(cast(Any, done).rowcount)

    def names(self, kind: str, ids: set[str]) -> dict[str, str]:
        """The names of the plans in the library, or of the runs, with these ids."""
        table: Any = {"version": LibraryPlan, "run": Run}.get(kind)
        if table is None or not ids:
            return {}
        return {one: name for one, name in self.session.execute(sa.select(table.id, table.name).where(table.id.in_(ids)))}
