"""SQL that every kind of job needs. Never commits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, NamedTuple, TypeVar, cast

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import lock
from app.jobs.states import State
from app.jobs.tables import Job, Ordered

Row = TypeVar("Row", bound=Job)


class Begun(NamedTuple):
    """A job that runs: its id, the turn that started it, and its worker."""

    job: str
    turn: str
    worker: str


class JobRepository(Generic[Row]):
    """SQL that every kind of job needs. Never commits."""

    def __init__(self, session: Session, table: type[Row]):
        self.session, self.table = session, table

    def add(self, jobs: Sequence[Row]) -> None:
        self.session.add_all(jobs)
        self.session.flush()

    def get(self, job_id: str) -> Row | None:
        return self.session.scalar(sa.select(self.table).where(self.table.id == job_id))

    def locked(self, job_id: str) -> Row | None:
        """The job as it is now, locked against other writers until the end of the transaction."""
        table: Any = self.table
        lock(self.session, table.attempt, table.id == job_id)
        found = sa.select(self.table).where(self.table.id == job_id).execution_options(populate_existing=True)
        return self.session.scalar(found)

    def ids(self, state: State) -> list[str]:
        """The ids of the jobs in a state, oldest first."""
        return list(self.session.scalars(sa.select(self.table.id).where(self.table.state == state).order_by(self.table.number)))

    def first_ids(self, state: State, most: int) -> list[str]:
        """The ids of the oldest jobs in a state, `most` at most."""
        found = sa.select(self.table.id).where(self.table.state == state).order_by(self.table.number)
        return list(self.session.scalars(found.limit(most)))

    def running(self) -> list[Begun]:
        """The jobs that run."""
        turn = self._ordered().turn if issubclass(self.table, Ordered) else self.table.id
        found = sa.select(self.table.id, turn, self.table.worker).where(self.table.state == State.RUNNING)
        return [Begun(job, turn or job, worker or "") for job, turn, worker in self.session.execute(found)]

    def any_in(self, state: State, where: sa.ColumnElement[bool] | None = None) -> bool:
        """Whether a job is in a state, and meets a condition."""
        found = sa.select(self.table.id).where(self.table.state == state, sa.true() if where is None else where)
        return self.session.scalar(found.limit(1)) is not None

    def count(self, state: State) -> int:
        return self.session.scalar(sa.select(sa.func.count()).where(self.table.state == state)) or 0

    def to_stop(self, job_id: str, attempt: int) -> bool:
        table = self.table
        runs_on = (table.id == job_id) & (table.attempt == attempt) & (table.state == State.RUNNING)
        return self.session.scalar(sa.select(table.id).where(runs_on, table.cancel_requested_by.is_(None))) is None

    def progress(self, job_id: str, attempt: int, doing: str, share: float) -> None:
        """Store the progress of an attempt while it runs."""
        table = self.table
        running = (table.id == job_id) & (table.attempt == attempt) & (table.state == State.RUNNING)
        self._change(running, doing=doing, share=share)

    def remove(self, job: Row) -> None:
        self.session.delete(job)
        self.session.flush()

    def of_turn(self, turn: str) -> str | None:
        """The id of the job of an ordered kind that an earlier delivery of this turn started."""
        return self.session.scalar(sa.select(self.table.id).where(self._ordered().turn == turn))

    def give_back(self, job: Row) -> None:
        """Forget the turn of a job that goes back to the queue: any turn may start it again."""
        cast(Any, job).turn = None

    def first(self, may_start: sa.ColumnElement[bool], turn: str) -> Row | None:
        """The first queued job of an ordered kind that may start, locked and taken by `turn`. The caller has locked the queue.

        Another transaction may have cancelled it meanwhile, or cancelled and deleted it; then the next one is taken.
        """
        while True:
            queued = sa.select(self.table.id).where(self.table.state == State.QUEUED, may_start)
            found = self.session.scalar(queued.order_by(*self.in_order()).limit(1))
            job = self.locked(found) if found else None
            if job is None:
                return None
            if job.state is State.QUEUED:
                taken: Any = job
                taken.turn, taken.beside = turn, self.count(State.RUNNING)
                return job

    def in_order(self) -> tuple[Any, ...]:
        """The order in which the queued jobs of an ordered kind start."""
        table = self._ordered()
        return table.priority.desc(), sa.func.coalesce(table.position, self.table.number), self.table.number

    def _ordered(self) -> Any:
        assert issubclass(self.table, Ordered)
        return self.table

    def _change(self, where: sa.ColumnElement[bool], **values: Any) -> None:
        change = sa.update(cast(Any, self.table)).where(where).values(**values)
        self.session.execute(change, execution_options={"synchronize_session": False})
