"""The recorder: a thread that stores entries after the requests that they record were answered.

A request never waits for it. Entries wait in memory until the database takes them, so an entry is lost where the service is
killed before; the number of entries that did not fit into memory is itself recorded.
"""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from typing import Any

from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session, sessionmaker

from app.audit.log import SERVICE, Acting, AuditLog
from app.db import unit_of_work

log = logging.getLogger("rths.audit")
MOST_WAITING = 10_000
AT_ONCE = 200
AGAIN_S = 1.0
LAST_S = 3.0  # for what still waits when the service stops
SAME_S = 60.0  # equal refusals within this time make one entry
MOST_REFUSALS = 100  # different refusals within this time that are stored; more are only counted


@dataclass(frozen=True, slots=True)
class Waiting:
    """An entry that waits to be stored."""

    who: Acting
    action: str
    about: str = ""
    details: Mapping[str, Any] = field(default_factory=dict)
    at: datetime = field(default_factory=lambda: datetime.now(UTC))


class Recorder:
    """Stores entries in their order, and again until the database takes them."""

    def __init__(self, sessions: sessionmaker[Session]):
        self.sessions = sessions
        self.waiting: queue.Queue[Waiting | None] = queue.Queue(MOST_WAITING)
        self.lost = 0
        self._refusals: dict[tuple[str, ...], tuple[float, int]] = {}
        self._lock = threading.Lock()
        self._until: float | None = None
        self._thread = threading.Thread(target=self._work, name="audit", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Store what waits, for a few seconds at most."""
        self._until = time.monotonic() + LAST_S
        self._put(None)
        self._thread.join(LAST_S + AGAIN_S)

    def put(self, entry: Waiting) -> None:
        """Store an entry soon. Never waits."""
        self._put(entry)

    def refused(self, entry: Waiting) -> None:
        """Store a refusal. Equal ones within a minute are counted and make one entry, so that nobody floods the log."""
        key = (entry.who.who, *(str(entry.details.get(one)) for one in ("address", "method")), entry.action)
        now = time.monotonic()
        with self._lock:
            self._refusals = {one: at for one, at in self._refusals.items() if now - at[0] < SAME_S or at[1]}
            since, more = self._refusals.get(key, (-SAME_S, 0))
            if now - since < SAME_S or len(self._refusals) >= MOST_REFUSALS:
                self._refusals[key] = (since, more + 1)
                return
            self._refusals[key] = (now, 0)
        self._put(replace(entry, details={**entry.details, "equal_before": more}) if more else entry)

    def _put(self, entry: Waiting | None) -> None:
        try:
            self.waiting.put_nowait(entry)
        except queue.Full:
            with self._lock:
                self.lost += 1

    def _work(self) -> None:
        over = False
        while not over:
            entries = [self.waiting.get()]
            while len(entries) < AT_ONCE and not self.waiting.empty():
                entries.append(self.waiting.get())
            over = None in entries
            self._store([one for one in entries if one is not None])
            for _ in entries:
                self.waiting.task_done()

    def _store(self, entries: list[Waiting]) -> None:
        while entries or self.lost:
            lost = self.lost
            try:
                with unit_of_work(self.sessions) as session:
                    audit = AuditLog(session)
                    for one in entries:
                        audit.add(one.who, one.action, one.about, one.details, one.at)
                    if lost:
                        audit.add(SERVICE, "audit.lost", details={"entries": lost})
                with self._lock:
                    self.lost -= lost
                return
            except SQLAlchemyError as error:
                log.warning("%d entries of the audit log wait: %s", len(entries), error)
                if self._until is not None and time.monotonic() > self._until:
                    return
                time.sleep(AGAIN_S)
