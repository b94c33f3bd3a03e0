"""SQL of the list of the audit log. Never commits."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.audit.tables import AuditEntry
from app.models import Run
from app.runs.conditions import contains


@dataclass(frozen=True, slots=True)
class Wanted:
    """Filter and page of the list. `who` and `action` are parts of a name; `run` is an id."""

    who: str = ""
    action: str = ""
    since: datetime | None = None
    until: datetime | None = None
    run: str = ""
    limit: int = 50
    offset: int = 0


class AuditRepository:
    """SQL of the list of the audit log. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def listed(self, wanted: Wanted) -> tuple[list[AuditEntry], int]:
        """The entries of a page, newest first, and the number of all that match."""
        query = sa.select(AuditEntry).where(*_conditions(wanted))
        total = self.session.scalar(sa.select(sa.func.count()).select_from(query.subquery())) or 0
        page = query.order_by(AuditEntry.number.desc()).limit(wanted.limit).offset(wanted.offset)
        return list(self.session.scalars(page)), total

    def runs(self, ids: Iterable[str]) -> dict[str, Run]:
        """The runs with these ids."""
        return {run.id: run for run in self.session.scalars(sa.select(Run).where(Run.id.in_(list(ids))))}

    def run_id(self, number: int) -> str | None:
        return self.session.scalar(sa.select(Run.id).where(Run.number == number))


def _conditions(wanted: Wanted) -> Iterable[sa.ColumnElement[bool]]:
    if wanted.who:
        yield contains(AuditEntry.who, wanted.who)
    if wanted.action:
        yield contains(AuditEntry.action, wanted.action)
    if wanted.since:
        yield AuditEntry.at >= wanted.since
    if wanted.until:
        yield AuditEntry.at < wanted.until
    if wanted.run:
        yield sa.or_(AuditEntry.about == f"run:{wanted.run}", contains(AuditEntry.details, wanted.run))
