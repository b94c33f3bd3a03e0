"""Abort in a worker: while the latch is set no test starts, and running tests are stopped, whatever the database does."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from sqlalchemy.orm import Session, sessionmaker

from app.db import unit_of_work
from app.jobs.aborts import Aborts
from app.jobs.kind import Kind
from app.latch import Latch

log = logging.getLogger("rths.worker")
AGAIN_S = 0.05  # between two looks for a test that was about to start when the latch was set
LOOK_S = 1.0


class Stopper:
    """Stops tests while the latch is set, in a thread that uses no database. `tell` is called when there is news."""

    def __init__(self, latch: Latch):
        self.latch = latch
        self.acknowledged: list[str] = []
        self.stopping: list[str] = []
        self.tell: Callable[[], None] = lambda: None
        self._wake = threading.Event()
        self._looked = 0.0
        self._recorded: set[str] = set()
        latch.listen(self._wake.set)

    def start(self, stop: Callable[[], list[str]]) -> None:
        """Serve from now on. `stop` stops the running tests and returns the ids of those that engines still execute."""
        threading.Thread(target=self._keep, args=(stop,), daemon=True, name="rths-stopper").start()

    def as_dict(self) -> dict[str, Any]:
        """The message to the services."""
        return {"latch": self.latch.as_dict(), "acknowledged": self.acknowledged, "stopping": self.stopping}

    def look(self, maker: sessionmaker[Session], kinds: Sequence[Kind[Any, Any, Any]]) -> None:
        """Record the presses where the service has not done it, and hear of a release that no service told: once a second."""
        presses = self.latch.presses
        if not presses or time.monotonic() - self._looked < LOOK_S:
            return
        self._looked = time.monotonic()
        with unit_of_work(maker) as session:
            aborts = Aborts(session)
            for press in presses:
                if press.id not in self._recorded:
                    aborts.record(press, kinds)
            released = aborts.released([press.id for press in presses])
        self._recorded = {press.id for press in presses}
        self.latch.merge([], released)

    def _keep(self, stop: Callable[[], list[str]]) -> None:
        while True:
            self._wake.wait(AGAIN_S if self.latch.held else None)
            self._wake.clear()
            presses = [one.id for one in self.latch.presses]
            stopping = stop() if presses else []
            if (presses, stopping) != (self.acknowledged, self.stopping):
                self.acknowledged, self.stopping = presses, stopping
                self.tell()
