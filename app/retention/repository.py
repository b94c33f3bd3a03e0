"""SQL of retention. Never commits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import now
from app.models import Annotation, Diagnosis, DiagnosisInput, Rules, Run
from app.retention.schemas import ENDED, Rule

KEEP = "keep"
YOUNGEST = timedelta(days=1)  # a rule never removes the recording of a test that ended later than this before now
CHUNK = 1000


class RetentionRows:
    """The rule, and the recordings of runs that it removes."""

    def __init__(self, session: Session):
        self.session = session

    @property
    def rules(self) -> Rules:
        return self.session.get_one(Rules, 1)

    def now(self) -> datetime:
        """The time by the clock of the database."""
        return now(self.session)

    def claim(self, due: datetime) -> bool:
        """Set when recordings are removed next; other removals wait for this transaction. False where all are kept."""
        change = sa.update(Rules).where(Rules.id == 1, Rules.retention_due.is_not(None)).values(retention_due=due)
        done = self.session.execute(change, execution_options={"synchronize_session": False})
        return bool(done.rowcount)  # type: ignore[attr-defined]

    def total(self) -> int:
        """The size (bytes) of all recordings of runs."""
        return int(self.session.scalar(sa.select(sa.func.sum(Run.recording_size))) or 0)

    def oldest(self, rule: Rule, moment: datetime) -> Iterator[Any]:
        """The recordings that the rule may remove, the oldest first."""
        what = sa.select(Run.number, Run.id, Run.name, Run.finished_at, Run.recording_size)
        query = what.where(*_may_go(rule, moment)).order_by(Run.finished_at, Run.number)
        with self.session.execute(query.execution_options(yield_per=CHUNK)) as found:
            yield from found

    def locked(self, rule: Rule, moment: datetime, numbers: Sequence[int]) -> list[Any]:
        """Of these runs those whose recording may still go. Nobody can annotate or cite them before the transaction ends."""
        these = Run.number.in_(numbers)
        self.session.execute(sa.select(Run.number).where(these).order_by(Run.number).with_for_update())
        what = sa.select(Run.number, Run.id, Run.recording_size)
        return list(self.session.execute(what.where(these, *_may_go(rule, moment)).order_by(Run.number)))

    def remove(self, numbers: Sequence[int], moment: datetime) -> None:
        """Note in the rows of these runs that their recordings are removed."""
        values = {"recording_sha256": None, "recording_size": None, "recording_removed_at": moment}
        change = sa.update(Run).where(Run.number.in_(numbers)).values(values)
        self.session.execute(change, execution_options={"synchronize_session": False})

    def removed(self) -> set[str]:
        """The ids of the runs whose recordings were removed."""
        gone = Run.recording_removed_at.is_not(None) & Run.recording_sha256.is_(None)
        return set(self.session.scalars(sa.select(Run.id).where(gone)))


def _may_go(rule: Rule, moment: datetime) -> list[sa.ColumnElement[bool]]:
    """The recordings within the limits of a rule that nothing protects."""
    tags = sa.type_coerce(Run.tags, sa.Text)
    found = [
        Run.recording_sha256.is_not(None),
        Run.deleted_at.is_(None),
        Run.state.in_(rule.states or ENDED),
        Run.finished_at < moment - YOUNGEST,
        ~sa.func.lower(tags).contains(f"|{KEEP}|", autoescape=True),
        ~sa.exists().where(Annotation.run_number == Run.number),
        ~sa.exists().where(DiagnosisInput.run_id == Run.id),
        ~sa.exists().where(sa.or_(Diagnosis.before_id == Run.id, Diagnosis.after_id == Run.id)),
    ]
    if rule.template:
        found.append(Run.template == rule.template)
    if rule.tag:
        found.append(tags.contains(f"|{rule.tag}|", autoescape=True))
    return found
