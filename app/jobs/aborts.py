"""The record of Abort: every press in the database, with the hold of the queue and the tests that it stopped. Never commits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.hold import Hold
from app.jobs.kind import Kind
from app.jobs.service import JobService, named
from app.jobs.states import State
from app.jobs.tables import AbortPress
from app.latch import Press

ABORTED = "running tests aborted"


class Aborts:
    """The presses of Abort as the database knows them."""

    def __init__(self, session: Session):
        self.session = session

    def record(self, press: Press, kinds: Sequence[Kind[Any, Any, Any]]) -> list[str]:
        """Hold the queue and ask for the end of running tests; returns their ids. A press that is recorded changes nothing."""
        hold = Hold(self.session)
        hold.locked()
        services = [JobService(self.session, kind) for kind in kinds if kind.waits_while_held]
        if self.session.get(AbortPress, press.id) is not None:
            return [run for one in services for run in one.rows.ids(State.RUNNING)]
        self._add(press)
        hold.set(named(press.by), ABORTED)
        return [job.id for one in services for job in one.cancel_running(press.by)]

    def release(self, presses: Iterable[Press], by: str) -> list[str]:
        """End all presses, those of a latch that are not recorded yet too; returns their ids."""
        now = datetime.now(UTC)
        for press in presses:
            if self.session.get(AbortPress, press.id) is None:
                self._add(press)
        ids = [one.id for one in self.open()]
        ended = sa.update(AbortPress).where(AbortPress.id.in_(ids)).values(released_at=now, released_by=named(by))
        self.session.execute(ended, execution_options={"synchronize_session": False})
        return ids

    def open(self) -> list[Press]:
        """The presses that nobody released, oldest first."""
        found = sa.select(AbortPress).where(AbortPress.released_at.is_(None)).order_by(AbortPress.pressed_at)
        return [Press(one.id, one.pressed_by, one.pressed_at.isoformat()) for one in self.session.scalars(found)]

    def released(self, ids: Sequence[str]) -> list[str]:
        """Those of these presses that somebody released."""
        ended = sa.select(AbortPress.id).where(AbortPress.id.in_(ids), AbortPress.released_at.is_not(None))
        return list(self.session.scalars(ended))

    def _add(self, press: Press) -> None:
        self.session.add(
            AbortPress(id=press.id, pressed_by=named(press.by), pressed_at=press.time, recorded_at=datetime.now(UTC))
        )
        self.session.flush()
