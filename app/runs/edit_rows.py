"""SQL of what people say about runs, and of saved views. Never commits."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import Diagnosis, DiagnosisInput, Run, RunView
from app.runs import values


class EditRows:
    """Reads and removes runs for their changes by people."""

    def __init__(self, session: Session):
        self.session = session

    def get(self, ids: Iterable[str]) -> dict[str, Run]:
        return {run.id: run for run in self.session.scalars(sa.select(Run).where(Run.id.in_(list(ids))))}

    def diagnosis_of(self, run: Run) -> Diagnosis | None:
        """A diagnosis that uses the recording of a run, or that queued the run."""
        reads = sa.select(DiagnosisInput.diagnosis_number).where(DiagnosisInput.run_id == run.id)
        used = Diagnosis.number.in_(reads) | (Diagnosis.before_id == run.id) | (Diagnosis.after_id == run.id)
        return self.session.scalar(sa.select(Diagnosis).where(used).order_by(Diagnosis.number).limit(1))

    def deleted_before(self, moment: datetime, most: int) -> list[Run]:
        return list(self.session.scalars(sa.select(Run).where(Run.deleted_at < moment).order_by(Run.number).limit(most)))

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

    def get(self, view_id: int) -> RunView | None:
        return self.session.get(RunView, view_id)

    def add(self, view: RunView) -> None:
        self.session.add(view)
        self.session.flush()

    def remove(self, view: RunView) -> None:
        self.session.delete(view)
