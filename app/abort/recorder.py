"""The thread that writes Abort to the database, over a connection of its own, again and again until it is stored."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable

import sqlalchemy as sa
from sqlalchemy.exc import SQLAlchemyError

from app.db import connect, sessions, unit_of_work
from app.jobs.aborts import Aborts
from app.latch import Latch
from app.runs.job import RUNS

log = logging.getLogger(__name__)
PAUSES_S = (0.05, 0.1, 0.2, 0.5, 1.0)  # between two tries; the last again and again
LOOK_S = 1.0  # between two looks for a release by another service, while the latch is set
LOCK_WAIT_MS = 2000


class Recorder:
    """Writes each press of the latch once, and takes from the database what other services pressed and released."""

    def __init__(self, url: str, latch: Latch):
        self.latch = latch
        self.recorded: dict[str, list[str]] = {}
        """The presses that the database has, each with the ids of the runs that were asked to stop for it."""
        self.stored: Callable[[], None] = lambda: None
        self._engine = connect(url)
        if self._engine.dialect.name == "sqlite":
            sa.event.listen(self._engine, "connect", _impatient)
        self._maker = sessions(self._engine)
        self._wake, self._stopping = threading.Event(), False
        self._thread = threading.Thread(target=self._keep, daemon=True, name="rths-abort-recorder")

    def start(self) -> None:
        self.latch.listen(self._wake.set)
        self._thread.start()

    def stop(self) -> None:
        self._stopping = True
        self._wake.set()
        self._thread.join(5)
        self.latch.forget(self._wake.set)
        self._engine.dispose()

    def _keep(self) -> None:
        tried, known = 0, False
        while not self._stopping:
            self._wake.clear()
            try:
                if not known:
                    self._take_open()
                    known = True
                self._record()
            except SQLAlchemyError as error:
                log.warning("Abort is not recorded yet: %s", error)
                pause = PAUSES_S[min(tried, len(PAUSES_S) - 1)]
                tried += 1
                time.sleep(pause)
                continue
            tried = 0
            self._wake.wait(LOOK_S if self.latch.held else None)

    def _take_open(self) -> None:
        """A service that starts holds what nobody released."""
        with unit_of_work(self._maker) as session:
            found = Aborts(session).open()
        self.recorded.update({one.id: [] for one in found})
        self.latch.merge(found, [])

    def _record(self) -> None:
        presses = self.latch.presses
        for press in presses:
            if press.id not in self.recorded:
                with unit_of_work(self._maker) as session:
                    stopping = Aborts(session).record(press, [RUNS])
                self.recorded[press.id] = stopping
                self.stored()
        if presses:
            with unit_of_work(self._maker) as session:
                released = Aborts(session).released([press.id for press in presses])
            self.latch.merge([], released)


def _impatient(connection: object, _: object) -> None:
    connection.execute(f"pragma busy_timeout={LOCK_WAIT_MS}")  # type: ignore[attr-defined]
