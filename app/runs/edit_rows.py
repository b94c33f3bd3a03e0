"""SQL of what people say about runs, and of saved views. Never commits."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import lock, locked, put
from app.jobs.states import State
from app.models import Diagnosis, DiagnosisInput, Rules, Run, RunView
from app.runs import values


class EditRows:
    """Reads and removes runs for their changes by people."""

    def __init__(self, session: Session):
        self.session = session

    def locked(self, ids: Iterable[str]) -> dict[str, Run]:
        """The runs as they are now, locked against other writers until the end of the transaction."""
        return {run.id: run for run in self._locked(sa.select(Run).where(Run.id.in_(list(ids))).order_by(Run.number))}

    def diagnosis_of(self, run: Run) -> Diagnosis | None:
        """A diagnosis that uses the recording of a run, or that queued the run."""
        reads = sa.select(DiagnosisInput.diagnosis_number).where(DiagnosisInput.run_id == run.id)
        used = Diagnosis.number.in_(reads) | (Diagnosis.before_id == run.id) | (Diagnosis.after_id == run.id)
        return self.session.scalar(sa.select(Diagnosis).where(used).order_by(Diagnosis.number).limit(1))

    def deleted_before(self, moment: datetime, most: int) -> list[Run]:
        """Runs that were deleted before a moment and have ended, locked as by `locked`."""
        ended = Run.state.in_([state for state in State if state.ended])
        return self._locked(sa.select(Run).where(Run.deleted_at < moment, ended).order_by(Run.number).limit(most))

    def remove(self, run: Run) -> bool:
        """Remove a run for good. False where another table still refers to it."""
        try:
            with self.session.begin_nested():
                values.remove(self.session, run.number)
                self.session.delete(run)
                self.session.flush()
        except sa.exc.IntegrityError:
            return False
        return True

    def _locked(self, runs: sa.Select[Run]) -> list[Run]:
        """Runs locked in their order, so that two who lock the same ones never wait for each other."""
        lock(self.session, Run.attempt, sa.false())  # SQLite has no SELECT FOR UPDATE: the begin of a change locks the database
        return list(self.session.scalars(runs.with_for_update(key_share=True).execution_options(populate_existing=True)))

    def tags(self) -> list[str]:
        """Every tag that a run has, in the order of the alphabet."""
        found: set[str] = set()
        for tags in self.session.scalars(sa.select(Run.tags).where(sa.type_coerce(Run.tags, sa.Text) != "").distinct()):
            found.update(tags)
        return sorted(found, key=str.casefold)


class ViewRows:
    """Saved views of the run table."""

    def __init__(self, session: Session):
        self.session = session

    def listed(self) -> list[RunView]:
        return list(self.session.scalars(sa.select(RunView).order_by(RunView.name)))

    def named(self, name: str) -> RunView | None:
        return self.session.scalar(sa.select(RunView).where(RunView.name == name))

    def lock(self) -> None:
        """Let one person at a time save views, until the end of the transaction: by the row of the laboratory's rules."""
        lock(self.session, Rules.id, Rules.id == 1)

    def locked(self, view_id: int) -> RunView | None:
        """The view as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, RunView, id=view_id)

    def put(self, name: str, query: str, saved_by: str, saved_at: datetime) -> RunView:
        """Store a view in place of the one with this name, also where others do so at the same moment."""
        put(self.session, RunView, "name", name=name, query=query, saved_by=saved_by, saved_at=saved_at)
        stored = sa.select(RunView).where(RunView.name == name).execution_options(populate_existing=True)
        return self.session.scalars(stored).one()

    def remove(self, view: RunView) -> None:
        self.session.delete(view)
