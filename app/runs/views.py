"""Rules of saved views of the run table. No SQL, no HTTP."""

from __future__ import annotations

from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.jobs.service import named
from app.models import RunView
from app.problems import Conflict, NotFound
from app.runs.edit_rows import ViewRows

MOST_VIEWS = 200


class ViewService:
    """Saved views: a name for the query of an address of the run table."""

    def __init__(self, session: Session):
        self.rows = ViewRows(session)

    def listed(self) -> list[RunView]:
        return self.rows.listed()

    def save(self, name: str, query: str, by: str) -> RunView:
        """Save a view, in place of the one with the same name. Raises Conflict where there are too many."""
        self.rows.lock()
        if self.rows.named(name) is None and len(self.rows.listed()) >= MOST_VIEWS:
            raise Conflict(f"There are {MOST_VIEWS} saved views, which is the limit. Delete one first.")
        return self.rows.put(name, query.removeprefix("?"), named(by), datetime.now(UTC))

    def remove(self, view_id: str) -> None:
        """Delete a view. Raises NotFound."""
        known = view_id.isascii() and view_id.isdecimal() and len(view_id) < 10
        view = self.rows.locked(int(view_id)) if known else None
        if view is None:
            raise NotFound(f"There is no saved view {view_id}.")
        self.rows.remove(view)
