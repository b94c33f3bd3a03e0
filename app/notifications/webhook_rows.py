"""SQL of webhooks and deliveries. Never commits."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import locked
from app.events.tables import Webhook, WebhookDelivery

AT_ONCE = 20  # deliveries in one round
LEASE = timedelta(minutes=1)  # in which no other web process sends a delivery that this one took
WAITING, DELIVERED, FAILED = "waiting", "delivered", "failed"


class WebhookRows:
    """SQL of webhooks and deliveries. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def listed(self) -> list[Webhook]:
        return list(self.session.scalars(sa.select(Webhook).order_by(Webhook.number)))

    def get(self, webhook_id: str) -> Webhook | None:
        return self.session.scalar(sa.select(Webhook).where(Webhook.id == webhook_id))

    def locked(self, webhook_id: str) -> Webhook | None:
        """The webhook as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, Webhook, id=webhook_id)

    def add(self, row: Webhook | WebhookDelivery) -> None:
        self.session.add(row)
        self.session.flush()

    def remove(self, webhook: Webhook) -> None:
        self.session.execute(sa.delete(WebhookDelivery).where(WebhookDelivery.webhook_number == webhook.number))
        self.session.delete(webhook)

    def deliveries(self, webhook: Webhook, limit: int) -> list[WebhookDelivery]:
        """The latest deliveries of a webhook, newest first."""
        query = sa.select(WebhookDelivery).where(WebhookDelivery.webhook_number == webhook.number)
        return list(self.session.scalars(query.order_by(WebhookDelivery.number.desc()).limit(limit)))

    def taken(self, now: datetime) -> list[WebhookDelivery]:
        """The deliveries that are due and enabled, taken by this process: no other sends them within LEASE."""
        due = (WebhookDelivery.state == WAITING) & (WebhookDelivery.next_at <= now)
        enabled = sa.select(WebhookDelivery).join(Webhook).where(due, Webhook.enabled).order_by(WebhookDelivery.number)
        return [one for one in self.session.scalars(enabled.limit(AT_ONCE)) if self._take(one, now)]

    def any_due(self, now: datetime) -> bool:
        due = (WebhookDelivery.state == WAITING) & (WebhookDelivery.next_at <= now)
        return self.session.scalar(sa.select(WebhookDelivery.number).where(due).limit(1)) is not None

    def store(self, number: int, **values: Any) -> None:
        self.session.execute(sa.update(WebhookDelivery).where(WebhookDelivery.number == number).values(**values))

    def _take(self, one: WebhookDelivery, now: datetime) -> bool:
        same = (WebhookDelivery.number == one.number) & (WebhookDelivery.next_at == one.next_at)
        change = sa.update(WebhookDelivery).where(same).values(next_at=now + LEASE)
        changed: Any = self.session.execute(change, execution_options={"synchronize_session": False})
        return bool(changed.rowcount)
