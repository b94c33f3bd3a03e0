"""Rules of notifications: which events go to which receivers. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from sqlalchemy.orm import Session

from app.events.log import EventLog
from app.events.tables import EventKind
from app.notifications.schemas import EventList, EventOut


class NotificationService:
    """What happened, for people who were not there."""

    def __init__(self, session: Session):
        self.log = EventLog(session)

    def events(self, since: datetime | None, after: int, kinds: Sequence[EventKind], run_id: str, limit: int) -> EventList:
        """Events later than `since` and with a number above `after`, newest first."""
        found, total = self.log.listed(since, after, kinds, run_id, limit)
        return EventList(events=[EventOut.model_validate(one) for one in found], total=total, latest=self.log.latest())
