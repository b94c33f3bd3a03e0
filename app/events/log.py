"""SQL of events. Never commits: an event and its deliveries are stored in the transaction of what it tells, or not at all."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.audit.log import AuditLog
from app.audit.requests import recorded
from app.events.tables import Event, EventKind, Webhook, WebhookDelivery


class EventLog:
    """The table of events."""

    def __init__(self, session: Session):
        self.session = session

    def add(self, kind: EventKind, sentence: str, about: str, about_id: str | None = None, name: str = "") -> Event:
        event = Event(at=datetime.now(UTC), kind=kind, about=about, about_id=about_id, name=name, sentence=sentence)
        self.session.add(event)
        for webhook in self.session.scalars(sa.select(Webhook).where(Webhook.enabled)):
            if kind in webhook.kinds:
                self.session.add(WebhookDelivery(webhook=webhook, event=event, next_at=event.at))
        if not recorded(self.session):
            audit = AuditLog(self.session)
            audit.add(audit.acting, f"{about}.{kind}", f"{about}:{about_id or ''}".rstrip(":"), {"sentence": sentence})
        return event

    def listed(
        self,
        since: datetime | None = None,
        after: int = 0,
        kinds: Sequence[EventKind] = (),
        run_id: str = "",
        limit: int = 50,
    ) -> tuple[list[Event], int]:
        """Events later than `since` and with a number above `after`, newest first; and how many there are without `limit`."""
        query = sa.select(Event).where(Event.number > after)
        if since is not None:
            query = query.where(Event.at > since)
        if kinds:
            query = query.where(Event.kind.in_(kinds))
        if run_id:
            query = query.where(Event.about == "run", Event.about_id == run_id)
        total = self.session.scalar(sa.select(sa.func.count()).select_from(query.subquery())) or 0
        return list(self.session.scalars(query.order_by(Event.number.desc()).limit(limit))), total

    def latest(self) -> int:
        """The number of the newest event; 0 before the first."""
        return self.session.scalar(sa.select(sa.func.max(Event.number))) or 0
