"""SQL of runs, the queue's state and heartbeats. Never commits."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session, defer

from app.models import QueueState, Run, RunStation, WorkerHeartbeat
from app.states import State

SORTS = {
    "number": Run.number,
    "name": Run.name,
    "state": Run.state,
    "submitted_by": Run.submitted_by,
    "submitted_at": Run.submitted_at,
    "finished_at": Run.finished_at,
    "elapsed_s": Run.elapsed_s,
    "simulated_s": Run.simulated_s,
    "template": Run.template,
}
MEASURES = tuple(column.name for column in RunStation.__table__.columns if isinstance(column.type, sa.Float))


@dataclass(frozen=True, slots=True)
class Filter:
    """What runs to list."""

    states: tuple[State, ...] = ()
    text: str = ""
    submitted_by: str = ""
    template: str = ""
    since: datetime | None = None
    until: datetime | None = None


@dataclass(frozen=True, slots=True)
class Page:
    """Order and part of a list."""

    sort: str = "number"
    descending: bool = True
    limit: int = 50
    offset: int = 0


class RunRepository:
    def __init__(self, session: Session):
        self.session = session

    def add(self, runs: list[Run]) -> None:
        self.session.add_all(runs)
        self.session.flush()

    def get(self, run_id: str) -> Run | None:
        return self.session.scalar(sa.select(Run).where(Run.id == run_id))

    def locked(self, run_id: str) -> Run | None:
        """The run as it is now, held against other writers until the end of the transaction.

        Writing it as it is locks the row; in SQLite, which has no SELECT FOR UPDATE, the database.
        """
        untouched = sa.update(Run).where(Run.id == run_id).values(attempt=Run.attempt)
        self.session.execute(untouched, execution_options={"synchronize_session": False})
        return self.session.scalar(sa.select(Run).where(Run.id == run_id).execution_options(populate_existing=True))

    def listed(self, wanted: Filter, page: Page) -> tuple[list[Run], int]:
        query = self._filtered(wanted)
        total = self.session.scalar(sa.select(sa.func.count()).select_from(query.subquery())) or 0
        column, _, station = page.sort.partition(":")
        order = self._measure(column, int(station)) if station else SORTS[column]
        ordered = (order.desc() if page.descending else order.asc()).nulls_last()
        query = query.options(defer(Run.plan)).order_by(ordered, Run.number.desc())
        return list(self.session.scalars(query.limit(page.limit).offset(page.offset))), total

    def in_states(self, *states: State) -> list[Run]:
        query = sa.select(Run).where(Run.state.in_(states)).options(defer(Run.plan)).order_by(Run.number)
        return list(self.session.scalars(query))

    def count(self, state: State) -> int:
        return self.session.scalar(sa.select(sa.func.count()).where(Run.state == state)) or 0

    def cancel_requested(self, run_ids: list[str]) -> dict[str, str]:
        """Which of these runs someone asked to stop, and who."""
        query = sa.select(Run.id, Run.cancel_requested_by).where(Run.id.in_(run_ids), Run.cancel_requested_by.is_not(None))
        return {run_id: by or "" for run_id, by in self.session.execute(query)}

    def queue_state(self) -> QueueState:
        return self.session.get_one(QueueState, 1, populate_existing=True)

    def hold(self, by: str) -> None:
        self._set_queue(held=True, held_by=by, held_at=datetime.now(UTC))

    def release(self) -> None:
        self._set_queue(held=False, held_by=None, held_at=None)

    def held(self) -> bool:
        return bool(self.session.scalar(sa.select(QueueState.held).where(QueueState.id == 1)))

    def locked_queue(self) -> QueueState:
        """The queue's state, which nobody else can change until the end of the transaction; locks as `locked` does."""
        self._set_queue(held=QueueState.held)
        return self.session.get_one(QueueState, 1, populate_existing=True)

    def beat(self, worker: str) -> None:
        self.session.merge(WorkerHeartbeat(worker=worker, seen_at=datetime.now(UTC)))

    def last_beat(self) -> datetime | None:
        newest = sa.select(WorkerHeartbeat).order_by(WorkerHeartbeat.seen_at.desc()).limit(1)
        found = self.session.scalar(newest)
        return found.seen_at if found else None

    def silent_workers(self, before: datetime) -> list[str]:
        return list(self.session.scalars(sa.select(WorkerHeartbeat.worker).where(WorkerHeartbeat.seen_at < before)))

    def forget_worker(self, worker: str) -> None:
        self.session.execute(sa.delete(WorkerHeartbeat).where(WorkerHeartbeat.worker == worker))

    def _filtered(self, wanted: Filter) -> sa.Select[Run]:
        query = sa.select(Run)
        if wanted.states:
            query = query.where(Run.state.in_(wanted.states))
        if wanted.text:
            like = f"%{_escaped(wanted.text)}%"
            query = query.where(Run.name.ilike(like, escape="\\") | Run.id.ilike(like, escape="\\"))
        if wanted.submitted_by:
            query = query.where(Run.submitted_by.ilike(f"%{_escaped(wanted.submitted_by)}%", escape="\\"))
        if wanted.template:
            query = query.where(Run.template == wanted.template)
        if wanted.since:
            query = query.where(Run.submitted_at >= wanted.since)
        if wanted.until:
            query = query.where(Run.submitted_at < wanted.until)
        return query

    def _set_queue(self, **values: Any) -> None:
        change = sa.update(QueueState).where(QueueState.id == 1).values(**values)
        self.session.execute(change, execution_options={"synchronize_session": False})

    @staticmethod
    def _measure(name: str, station: int) -> sa.ScalarSelect[float]:
        column = getattr(RunStation, name)
        return sa.select(column).where(RunStation.run_number == Run.number, RunStation.number == station).scalar_subquery()


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace("%", "\\%").replace("_", "\\_")
