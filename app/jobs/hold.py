"""The hold of the queue: while the queue is held, no test starts. Never commits."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import lock
from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs.tables import QueueState


class Hold:
    """The switch that holds the queue of tests."""

    def __init__(self, session: Session):
        self.session = session

    @property
    def state(self) -> QueueState:
        return self.session.get_one(QueueState, 1, populate_existing=True)

    @property
    def held(self) -> bool:
        return bool(self.session.scalar(sa.select(QueueState.held).where(QueueState.id == 1)))

    def set(self, by: str, reason: str = "") -> None:
        """Hold the queue. Jobs that run go on."""
        self._change(held=True, held_by=by, held_at=datetime.now(UTC), held_reason=reason)
        self._tell(EventKind.HELD, f"{by} held the queue{': ' if reason else '.'}{reason}")

    def release(self, by: str) -> None:
        """Release the queue. A queue that was not held makes no event."""
        if self.locked().held:
            self._change(held=False, held_by=None, held_at=None, held_reason="")
            self._tell(EventKind.RELEASED, f"{by} released the queue.")

    def locked(self) -> QueueState:
        """The state, locked against other writers until the end of the transaction."""
        lock(self.session, QueueState.held, QueueState.id == 1)
        return self.state

    def _tell(self, kind: EventKind, sentence: str) -> None:
        EventLog(self.session).add(kind, sentence, "queue")

    def _change(self, **values: Any) -> None:
        change = sa.update(QueueState).where(QueueState.id == 1).values(**values)
        self.session.execute(change, execution_options={"synchronize_session": False})
