"""Rules of retention: which recordings of runs go, and their removal. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta
from functools import partial
from itertools import islice
from typing import Any, NamedTuple

from sqlalchemy.orm import Session

from app.audit.log import Acting, AuditLog
from app.db import afterwards
from app.disk import shown
from app.retention.repository import RetentionRows
from app.retention.schemas import GIGABYTE, Going, Preview, RetentionOut, Rule
from app.store.base import Store
from app.store.filed import RECORDINGS, of_run

PERIOD = timedelta(days=1)  # between two removals, and from a change of the rule to the first one
BATCH = 200  # recordings of one transaction and of one entry of the audit log
SHOWN = 5


class Removed(NamedTuple):
    """Number and size (bytes) of recordings that were removed."""

    recordings: int
    bytes: int

    @property
    def sentence(self) -> str:
        return f"Removed {_counted(self.recordings)}, {shown(self.bytes)}."


class Retention:
    """The rule of a laboratory, and what it removes."""

    def __init__(self, session: Session):
        self.rows, self.session = RetentionRows(session), session

    @property
    def rule(self) -> Rule:
        """The rule that holds; at first it keeps all recordings."""
        return Rule.model_validate(self.rows.rules.retention or {})

    def shown(self) -> RetentionOut:
        """The rule that holds, and when it removes recordings next."""
        rule = self.rule
        return RetentionOut(**rule.model_dump(), due_at=self.rows.rules.retention_due, sentence=rule.words)

    def save(self, rule: Rule) -> RetentionOut:
        """Set the rule. It removes nothing within the next PERIOD, so that a mistake can be undone."""
        if rule.model_dump() != self.rule.model_dump():
            self.rows.rules.retention = rule.model_dump(mode="json")
            self.rows.rules.retention_due = self.rows.now() + PERIOD if rule.acts else None
        return self.shown()

    def due(self) -> bool:
        """Whether it is time to remove recordings."""
        due = self.rows.rules.retention_due
        return due is not None and due <= self.rows.now()

    def preview(self, rule: Rule | None = None) -> Preview:
        """What a rule, by default the one that holds, would remove now."""
        rule, total = rule or self.rule, self.rows.total()
        recordings, size, oldest = 0, 0, []
        for row in self._going(rule, self.rows.now()):
            if recordings < SHOWN:
                number, run_id, name, finished, own = row
                oldest.append(Going(id=run_id, number=number, name=name, finished_at=finished, size=own or 0))
            recordings, size = recordings + 1, size + (row.recording_size or 0)
        told = _told(rule, recordings, size, total)
        return Preview(recordings=recordings, bytes=size, total_bytes=total, oldest=oldest, sentence=told)

    def remove(self, store: Store, who: Acting) -> Removed:
        """Remove at most BATCH recordings: their rows say so now, and the files go after the commit."""
        moment = self.rows.now()
        if not self.rows.claim(moment + PERIOD):
            return Removed(0, 0)
        rule = self.rule
        numbers = [row.number for row in islice(self._going(rule, moment), BATCH)]
        going = self.rows.locked(rule, moment, numbers)
        if not going:
            return Removed(0, 0)
        self.rows.remove([row.number for row in going], moment)
        found = Removed(len(going), sum(row.recording_size or 0 for row in going))
        ids = [row.id for row in going]
        details: dict[str, Any] = {"rule": rule.words, "recordings": found.recordings, "bytes": found.bytes, "runs": ids}
        AuditLog(self.session).add(who, "retention.removed", details=details)
        for one in ids:
            afterwards(self.session, "after_commit", partial(store.discard, of_run(one)))
        return found

    def clear(self, store: Store) -> None:
        """Delete the files that an interrupted removal, or a store that did not answer, has left."""
        names = {key.removeprefix(f"{RECORDINGS}/").removesuffix(".h5") for key in store.listed(RECORDINGS)}
        for left in sorted(names & self.rows.removed()):
            store.discard(of_run(left))

    def _going(self, rule: Rule, moment: datetime) -> Iterator[Any]:
        """What a rule removes, the oldest first."""
        left, limit = self.rows.total(), (rule.gigabytes or 0) * GIGABYTE
        kept_from = moment - timedelta(days=rule.days) if rule.days else None
        for row in self.rows.oldest(rule, moment) if rule.acts else ():
            old = kept_from is not None and row.finished_at < kept_from
            if not old and not (limit and left > limit):
                return
            left -= row.recording_size or 0
            yield row


def _told(rule: Rule, recordings: int, size: int, total: int) -> str:
    """What a rule removes, in words."""
    if not rule.acts:
        return f"The rule removes nothing. All recordings of runs take {shown(total)}."
    gone = f"The rule removes {_counted(recordings)} now, {shown(size)}" if recordings else "The rule removes nothing now"
    over = rule.gigabytes is not None and total - size > rule.gigabytes * GIGABYTE
    why = f", more than {rule.gigabytes:g} GB, because the rule keeps them" if over else ""
    return f"{gone}. All recordings of runs take {shown(total)}; {shown(total - size)} remain{why}."


def _counted(recordings: int) -> str:
    return "1 recording" if recordings == 1 else f"{recordings} recordings"
