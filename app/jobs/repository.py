"""SQL that every kind of job needs. Never commits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, TypeVar, cast

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.states import State
from app.jobs.tables import Job

Row = TypeVar("Row", bound=Job)


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
        """The job as it is now, locked against other writers until the end of the transaction.

        An update without changes locks the row. In SQLite, which has no SELECT FOR UPDATE, it locks the database.
        """
        self._change(self.table.id == job_id, attempt=self.table.attempt)
        found = sa.select(self.table).where(self.table.id == job_id).execution_options(populate_existing=True)
        return self.session.scalar(found)

    def ids(self, state: State) -> list[str]:
        """The ids of the jobs in a state, oldest first."""
        return list(self.session.scalars(sa.select(self.table.id).where(self.table.state == state).order_by(self.table.number)))

    def cancel_requested(self, job_id: str) -> bool:
        return self.session.scalar(sa.select(self.table.cancel_requested_by).where(self.table.id == job_id)) is not None

    def progress(self, job_id: str, attempt: int, doing: str, share: float) -> None:
        """Store the progress of an attempt while it runs."""
        table = self.table
        running = (table.id == job_id) & (table.attempt == attempt) & (table.state == State.RUNNING)
        self._change(running, doing=doing, share=share)

    def remove(self, job: Row) -> None:
        self.session.delete(job)
        self.session.flush()

    def _change(self, where: sa.ColumnElement[bool], **values: Any) -> None:
        change = sa.update(cast(Any, self.table)).where(where).values(**values)
        self.session.execute(change, execution_options={"synchronize_session": False})
