"""Rules of webhooks: add, change, test and remove them, and the log of their deliveries. No SQL, no HTTP."""

from __future__ import annotations

import secrets
import uuid
from datetime import UTC, datetime
from urllib.parse import urlsplit

from sqlalchemy.orm import Session

from app.events.tables import Webhook, WebhookDelivery
from app.notifications.schemas import DeliveryOut, WebhookAdded, WebhookChange, WebhookIn, WebhookOut
from app.notifications.webhook_rows import WebhookRows
from app.problems import NotFound
from rths_engine.foundation.errors import Issue, RthsError

LOGGED = 50  # latest deliveries in the log of a webhook
NOBODY = "unnamed"


class WebhookService:
    """Rules of webhooks. No SQL, no HTTP."""

    def __init__(self, session: Session):
        self.rows = WebhookRows(session)

    def listed(self) -> list[WebhookOut]:
        return [self._out(one) for one in self.rows.listed()]

    def get(self, webhook_id: str) -> Webhook:
        """The webhook with this id. Raises NotFound."""
        return _found(self.rows.get(webhook_id), webhook_id)

    def _locked(self, webhook_id: str) -> Webhook:
        """The webhook with this id as it is now, locked against other writers. Raises NotFound."""
        return _found(self.rows.locked(webhook_id), webhook_id)

    def add(self, given: WebhookIn) -> WebhookAdded:
        """Add a webhook. Its secret is returned once; without one a secret is made."""
        webhook = Webhook(
            id=str(uuid.uuid4()),
            url=_checked(given.url),
            kinds=sorted(set(given.kinds)),
            secret=given.secret or secrets.token_urlsafe(24),
            enabled=True,
            added_by=given.by.strip() or NOBODY,
            added_at=datetime.now(UTC),
        )
        self.rows.add(webhook)
        return WebhookAdded(**self._out(webhook).model_dump(), secret=webhook.secret)

    def change(self, webhook_id: str, given: WebhookChange) -> WebhookOut:
        """Change address, kinds or whether it is enabled."""
        webhook = self._locked(webhook_id)
        if given.url is not None:
            webhook.url = _checked(given.url)
        if given.kinds is not None:
            webhook.kinds = sorted(set(given.kinds))
        if given.enabled is not None:
            webhook.enabled = given.enabled
        return self._out(webhook)

    def test(self, webhook_id: str) -> DeliveryOut:
        """Queue a delivery that tests the webhook; it is sent within about a second."""
        delivery = WebhookDelivery(webhook=self._locked(webhook_id), event=None, next_at=datetime.now(UTC))
        self.rows.add(delivery)
        return _delivery(delivery)

    def deliveries(self, webhook_id: str) -> list[DeliveryOut]:
        """The latest deliveries of a webhook, newest first."""
        return [_delivery(one) for one in self.rows.deliveries(self.get(webhook_id), LOGGED)]

    def remove(self, webhook_id: str) -> None:
        self.rows.remove(self._locked(webhook_id))

    def _out(self, webhook: Webhook) -> WebhookOut:
        last = self.rows.deliveries(webhook, 1)
        out = WebhookOut.model_validate(webhook)
        out.last = _delivery(last[0]) if last else None
        return out


def _found(webhook: Webhook | None, webhook_id: str) -> Webhook:
    if webhook is None:
        raise NotFound(f"There is no webhook {webhook_id}.")
    return webhook


def _checked(url: str) -> str:
    try:
        parts = urlsplit(url)
        good = parts.scheme in {"http", "https"} and bool(parts.hostname) and (parts.port is None or parts.port > 0)
    except ValueError:
        good = False
    if not good or any(character.isspace() for character in url):
        raise RthsError(Issue("url", "needs an address that begins with http:// or https://", url))
    return url


def _delivery(one: WebhookDelivery) -> DeliveryOut:
    told = {name: getattr(one, name) for name in ("number", "state", "attempts", "next_at", "last_at", "status", "problem")}
    event = one.event
    return DeliveryOut(**told, kind=event.kind if event else "test", sentence=event.sentence if event else "")
