"""Sends due deliveries in a thread of one web process, away from requests and from workers: no run waits for an address."""

from __future__ import annotations

import logging
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from datetime import UTC, datetime

from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session, sessionmaker

from app.db import unit_of_work
from app.events.tables import WebhookDelivery
from app.leases import Once
from app.notifications.schemas import EventOut
from app.notifications.sending import BACK_OFF, TEST, Parcel, Sent, send
from app.notifications.webhook_rows import DELIVERED, FAILED, WAITING, WebhookRows

log = logging.getLogger("rths.webhooks")
PERIOD_S = 1.0
SENDERS = 4


class Dispatcher:
    """Sends due deliveries, and again with growing pauses until the address accepts them or the attempts are used up."""

    def __init__(self, maker: sessionmaker[Session]):
        self.maker, self.once = maker, Once(maker)
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._keep, daemon=True, name="rths-webhooks")

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self._stopping.set()
        self._thread.join(10)
        with suppress(SQLAlchemyError):
            self.once.release("webhooks")

    def deliver(self) -> int:
        """Send what is due once; returns the number of deliveries sent."""
        now = datetime.now(UTC)
        with unit_of_work(self.maker) as session:
            if not WebhookRows(session).any_due(now):
                return 0
        with unit_of_work(self.maker) as session:
            parcels = [_parcel(one) for one in WebhookRows(session).taken(now)]
        with ThreadPoolExecutor(SENDERS) as senders:
            for parcel, sent in zip(parcels, senders.map(send, parcels), strict=True):
                self._store(parcel, sent)
        return len(parcels)

    def _store(self, parcel: Parcel, sent: Sent) -> None:
        now, attempts = datetime.now(UTC), parcel.attempts + 1
        left = attempts <= len(BACK_OFF)
        state = DELIVERED if sent.problem is None else WAITING if left else FAILED
        next_at = now + BACK_OFF[attempts - 1] if state == WAITING else now
        told = {"status": sent.status, "problem": sent.problem}
        with unit_of_work(self.maker) as session:
            WebhookRows(session).store(parcel.number, state=state, attempts=attempts, last_at=now, next_at=next_at, **told)

    def _keep(self) -> None:
        while not self._stopping.wait(PERIOD_S):
            try:
                if self.once.held("webhooks"):
                    self.deliver()
            except SQLAlchemyError as error:
                log.warning("the database did not answer: %s", error)


def _parcel(one: WebhookDelivery) -> Parcel:
    event = TEST if one.event is None else EventOut.model_validate(one.event).model_dump(mode="json")
    content = {"event": event, "webhook": one.webhook.id, "delivery": one.number}
    return Parcel(one.number, one.webhook.url, one.webhook.secret, content, one.attempts)
