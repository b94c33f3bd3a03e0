"""The filter of the Runs page, read from the address: an address is a view that can be stored and sent."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Any
from urllib.parse import urlencode

from pydantic import BaseModel

from app.jobs.states import State
from app.runs.repository import Filter, Page
from rths_engine.foundation.errors import Issue, RthsError

LIMIT = 50
LAST_PAGE = 1_000_000


class RunFilter(BaseModel):
    """The query of the address as typed."""

    q: str = ""
    state: str = ""
    template: str = ""
    submitted_by: str = ""
    since: str = ""
    until: str = ""
    sort: str = "submitted_at"
    order: str = "desc"
    page: str = "1"

    @property
    def number(self) -> int:
        return int(self.page) if self._numbered else 1

    @property
    def _numbered(self) -> bool:
        return self.page.isascii() and self.page.isdecimal() and 0 < int(self.page[:9]) <= LAST_PAGE

    @property
    def filters(self) -> bool:
        return any((self.q, self.state, self.template, self.submitted_by, self.since, self.until))

    def url(self, **changes: Any) -> str:
        """The address of this view with changes. A new order or filter starts at the first page."""
        changed = self.model_copy(update={"page": "1", **{key: str(value) for key, value in changes.items()}})
        return "/runs?" + urlencode(changed.model_dump(exclude_defaults=True))

    def filter(self) -> Filter:
        """The filter of the list. Raises RthsError for a value that is not valid."""
        if self.state and self.state not in list(State):
            raise RthsError(Issue("state", "is not a valid status of a run", self.state, "choose one of " + ", ".join(State)))
        if not self._numbered:
            raise RthsError(Issue("page", f"needs a whole number from 1 to {LAST_PAGE}", self.page))
        until = _day("until", self.until)
        return Filter(
            states=(State(self.state),) if self.state else (),
            text=self.q.strip(),
            submitted_by=self.submitted_by.strip(),
            template=self.template,
            since=_day("since", self.since),
            until=until + timedelta(days=1) if until else None,
        )

    def part(self) -> Page:
        return Page(sort=self.sort, descending=self.order != "asc", limit=LIMIT, offset=LIMIT * (self.number - 1))


def _day(where: str, text: str) -> datetime | None:
    if not text:
        return None
    try:
        return datetime.strptime(text, "%Y-%m-%d").replace(tzinfo=UTC)
    except ValueError:
        raise RthsError(Issue(where, "is not a valid date", text, "write the date as 2026-11-23")) from None
