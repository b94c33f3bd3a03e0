"""Removes recordings once a day, in a thread of one web process."""

from __future__ import annotations

import logging
import threading
from contextlib import suppress

from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session, sessionmaker

from app.audit.log import SERVICE, Acting
from app.db import unit_of_work
from app.leases import Once
from app.retention.service import Removed, Retention
from app.store.base import Store

log = logging.getLogger("rths.retention")
LEASE = "retention"
ASKED_S = 60.0  # between two looks whether a removal is due


class Removal:
    """Removes what the rule removes: one batch after another, in one process at a time."""

    def __init__(self, maker: sessionmaker[Session], store: Store, who: Acting = SERVICE):
        self.maker, self.store, self.who, self.once = maker, store, who, Once(maker)
        self.stopping = threading.Event()

    def due(self) -> bool:
        """Whether it is time to remove recordings."""
        with unit_of_work(self.maker) as session:
            return Retention(session).due()

    def remove(self) -> Removed:
        """Remove what the rule removes now."""
        recordings = size = 0
        while self.once.held(LEASE) and not self.stopping.is_set():
            with unit_of_work(self.maker) as session:
                one = Retention(session).remove(self.store, self.who)
            recordings, size = recordings + one.recordings, size + one.bytes
            if not one.recordings:
                break
        with unit_of_work(self.maker) as session:
            Retention(session).clear(self.store)
        self.once.release(LEASE)
        return Removed(recordings, size)


class Daily:
    """Removes recordings when they are due, away from requests."""

    def __init__(self, maker: sessionmaker[Session], store: Store):
        self.removal = Removal(maker, store)
        self._thread = threading.Thread(target=self._keep, daemon=True, name="rths-retention")

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self.removal.stopping.set()
        self._thread.join(10)
        with suppress(SQLAlchemyError):
            self.removal.once.release(LEASE)

    def _keep(self) -> None:
        while not self.removal.stopping.wait(ASKED_S):
            try:
                if self.removal.due():
                    log.info(self.removal.remove().sentence)
            except (SQLAlchemyError, OSError) as error:
                log.warning("recordings were not removed: %s", error)
