"""Rules of the list, the check and the export of the audit log. No SQL, no HTTP."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.audit.chain import EMPTY, Head, line
from app.audit.check import Checked, check
from app.audit.log import AuditLog
from app.audit.tables import AuditEntry
from app.auditing.repository import AuditRepository, Wanted
from app.auditing.schemas import AuditList, AuditOut, BrokenOut, ChainOut, HeadOut, RunNamed
from app.models import Run
from rths_engine.foundation.errors import Issue, RthsError

RUN = "run:"
NUMBER, HASH = re.compile("[0-9]{1,15}"), re.compile("[0-9a-f]{64}")


class AuditService:
    """The audit log for people."""

    def __init__(self, session: Session):
        self.log, self.rows = AuditLog(session), AuditRepository(session)

    def listed(self, wanted: Wanted) -> AuditList:
        """A page of entries, newest first. `wanted.run` is an id or the number of a run."""
        if wanted.run.isdecimal() and len(wanted.run) < 10:
            wanted = replace(wanted, run=self.rows.run_id(int(wanted.run)) or wanted.run)
        found, total = self.rows.listed(wanted)
        runs = self.rows.runs(one.about.removeprefix(RUN) for one in found if one.about.startswith(RUN))
        return AuditList(entries=[_out(one, runs) for one in found], total=total, head=self.head())

    def head(self) -> HeadOut:
        return _head(self.log.head())

    def check(self, noted: str = "") -> ChainOut:
        """Check the whole chain, and that it contains the head that was noted earlier as NUMBER:HASH.

        Raises RthsError for another text.
        """
        head = noted_head(noted) if noted else None
        found = check(self.log, head)
        return ChainOut(
            whole=found.broken is None,
            entries=found.entries,
            head=_head(found.head),
            broken=BrokenOut(**found.broken._asdict()) if found.broken else None,
            sentence=sentence(found),
            checked_at=datetime.now(UTC),
        )

    def lines(self) -> Iterator[str]:
        """Every entry as one line of JSON, the first one first."""
        for kept in self.log.entries():
            yield line(kept.entry, kept.previous, kept.hash)


def sentence(found: Checked) -> str:
    """The result of a check in words."""
    if found.broken:
        return f"The chain is broken: entry {found.broken.number} {found.broken.problem}."
    if found.head == EMPTY:
        return "The log has no entries."
    return f"The chain is whole: {found.entries} {'entry' if found.entries == 1 else 'entries'}, each with its own hash."


def noted_head(text: str) -> Head:
    """A head from NUMBER:HASH. Raises RthsError."""
    number, _, noted = text.strip().partition(":")
    if not (NUMBER.fullmatch(number) and HASH.fullmatch(noted)):
        raise RthsError(Issue("head", "is not NUMBER:HASH", text[:200], "give the line that `rths audit head` printed"))
    return Head(int(number), noted)


def _head(head: Head) -> HeadOut:
    return HeadOut(number=head.number, hash=head.hash, text=f"{head.number}:{head.hash}")


def _out(one: AuditEntry, runs: dict[str, Run]) -> AuditOut:
    run = runs.get(one.about.removeprefix(RUN))
    stored = {name: getattr(one, name) for name in AuditOut.model_fields if name not in {"run", "details"}}
    named = RunNamed(id=run.id, number=run.number, name=run.name) if run else None
    return AuditOut(**stored, run=named, details=json.loads(one.details))
