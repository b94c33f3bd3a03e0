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
MOST_REFUSALS = 100  # different refusals of one person, or of all who did not sign in, in this time; more are counted together
OTHERS = "others"


@dataclass(frozen=True, slots=True)
class Waiting:
    """An entry that waits to be stored."""

    who: Acting
    action: str
    about: str = ""
    details: Mapping[str, Any] = field(default_factory=dict)
    at: datetime = field(default_factory=lambda: datetime.now(UTC))


@dataclass(slots=True)
class _Refusal:
    """A refusal that was stored, and how many equal ones came since."""

    entry: Waiting
    since: float
    more: int = 0


class Recorder:
    """Stores entries in their order, and again until the database takes them."""

    def __init__(self, sessions: sessionmaker[Session]):
        self.sessions = sessions
        self.waiting: queue.Queue[Waiting | None] = queue.Queue(MOST_WAITING)
        self.lost = 0
        self._refusals: dict[tuple[str, ...], _Refusal] = {}
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
        with self._lock:
            counted = self._over(time.monotonic())
            if key not in self._refusals and sum(one[0] == key[0] for one in self._refusals) >= MOST_REFUSALS:
                key = (key[0], OTHERS)
            known = self._refusals.get(key)
            if known is None:
                self._refusals[key] = _Refusal(entry, time.monotonic())
            else:
                known.more += 1
        for one in [*counted, *([entry] if known is None else [])]:
            self._put(one)

    def _over(self, now: float) -> list[Waiting]:
        """Forget the refusals whose time is over, the first first; returns an entry for each that was counted meanwhile."""
        counted = []
        while self._refusals:
            key, oldest = next(iter(self._refusals.items()))
            if now - oldest.since < SAME_S:
                break
            del self._refusals[key]
            if oldest.more:
                counts = {"others_later" if key[1] == OTHERS else "equal_later": oldest.more}
                counted.append(replace(oldest.entry, details={**oldest.entry.details, **counts}))
        return counted

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
