"""SQL of the queue of tests. Never commits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, NamedTuple

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.models import Approval, Rig, Run

UNDOABLE = 20  # latest cancels that the queue shows
RECENT = 200  # latest completed runs that expected times follow from


class Waiting(NamedTuple):
    """A queued run without its plan and stations."""

    id: str
    number: int
    name: str
    priority: int
    position: float
    rig_id: str
    rig_name: str | None
    submitted_by: str
    submitted_at: datetime
    pace: float | None
    duration_s: float
    retry_of: str | None
    digest: str
    size: str | None
    samples: int | None


class Earlier(NamedTuple):
    """A completed run: how long it took, and what kind of test it was."""

    digest: str
    size: str | None
    samples: int | None
    rig_id: str
    pace: float | None
    beside: int | None
    elapsed_s: float
    started_at: datetime
    finished_at: datetime

    @property
    def wall_s(self) -> float:
        """Time from its start to the end of storing its result."""
        return (self.finished_at - self.started_at).total_seconds()


class QueueRepository:
    """SQL of the queue of tests. Never commits."""

    def __init__(self, session: Session):
        self.session = session
        self.runs = JobRepository(session, Run)

    def waiting(self, limit: int | None = None) -> list[Waiting]:
        """The queued runs in the order in which they start."""
        place = sa.func.coalesce(Run.position, Run.number)
        own: dict[str, Any] = {"position": place, "rig_name": Rig.name}
        columns = [own[name] if name in own else getattr(Run, name) for name in Waiting._fields]
        query = sa.select(*columns).outerjoin(Rig, Rig.id == Run.rig_id).where(Run.state == State.QUEUED)
        rows = self.session.execute(query.order_by(*self.runs.in_order()).limit(limit))
        return [Waiting._make(row) for row in rows]

    def earlier(self) -> list[Earlier]:
        """The latest completed runs whose size is known, newest first."""
        query = sa.select(*(getattr(Run, name) for name in Earlier._fields))
        known = (Run.state == State.COMPLETED, Run.size.is_not(None), Run.started_at.is_not(None), Run.elapsed_s.is_not(None))
        latest = query.where(*known).order_by(Run.finished_at.desc()).limit(RECENT)
        return [Earlier._make(row) for row in self.session.execute(latest)]

    def cancelled_in_queue(self, since: datetime) -> list[Run]:
        """The latest runs on the list that were cancelled after `since` and had never started; not those that were rejected."""
        rejected = sa.select(Approval.about_id).where(Approval.decision == "rejected")
        never = (Run.state == State.CANCELLED, Run.started_at.is_(None), Run.finished_at > since)
        shown = (Run.deleted_at.is_(None), Run.archived.is_(False), Run.id.not_in(rejected))
        query = sa.select(Run).where(*never, *shown).order_by(Run.finished_at.desc()).limit(UNDOABLE)
        return list(self.session.scalars(query))

    def last_number(self) -> int:
        return self.session.scalar(sa.select(sa.func.max(Run.number))) or 0

    def rigs(self) -> dict[str, int | None]:
        """How many tests each rig takes at a time; None: any number."""
        return {rig: most for rig, most in self.session.execute(sa.select(Rig.id, Rig.tests_at_a_time))}

    def place(self, changed: Mapping[str, tuple[int, float]]) -> None:
        """Store priority and position of queued runs."""
        table: Any = Run.__table__
        change = (
            sa.update(table)
            .where(table.c.id == sa.bindparam("of"), table.c.state == State.QUEUED)
            .values(priority=sa.bindparam("new_priority"), position=sa.bindparam("new_position"))
        )
        rows = [{"of": run, "new_priority": at[0], "new_position": at[1]} for run, at in changed.items()]
        if rows:
            self.session.connection().execute(change, rows)

    def prioritise(self, runs: Sequence[str], priority: int) -> None:
        change = sa.update(Run).where(Run.id.in_(runs), Run.state == State.QUEUED).values(priority=priority)
        self.session.execute(change, execution_options={"synchronize_session": False})
