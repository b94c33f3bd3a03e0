"""Whether this worker is known to live: by its heartbeat in the database, or by a web service that it reaches instead.

A test that moves a machine goes on while one of the two answers. Without both, other workers take this one for dead after six
seconds and may start the next test on the same rig; so the processes of such tests stop before that: docs/decisions/0080.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any, Protocol

from app.worker.child import ASSURED_S

ASK_S = 2.0  # without a heartbeat of its own a worker asks the web services to beat for it
LOOK_S = 0.5


class Executing(Protocol):
    """The part of the executor that is used here."""

    def executing(self) -> list[dict[str, Any]]: ...
    def stop(self, job_id: str, attempt: int) -> None: ...
    def assure(self, left_s: float) -> None: ...


class Contact:
    """The last moment at which somebody else knew that this worker lives. Threads share it."""

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock = clock
        self._beaten = self._answered = clock()
        self._asked: dict[int, float] = {}
        self._number = 0
        self._lock = threading.Lock()
        self._executor: Executing | None = None
        self._tests_at_a_time = 1

    def serve(self, executor: Executing, tests_at_a_time: int) -> None:
        """Pass on to the processes of tests for how long this worker is known to live, from now on."""
        self._executor, self._tests_at_a_time = executor, tests_at_a_time
        threading.Thread(target=self._keep, args=(executor,), daemon=True, name="rths-contact").start()

    def beaten(self, since: float) -> None:
        """A heartbeat that began at the time `since` is in the database."""
        self._beaten = max(self._beaten, since)

    def now(self) -> float:
        return self._clock()

    @property
    def left_s(self) -> float:
        """For how long this worker is still known to live; not positive where it is cut off."""
        return max(self._beaten, self._answered) + ASSURED_S - self._clock()

    def question(self) -> dict[str, Any] | None:
        """What to ask a web service now; None while the database takes the heartbeats."""
        now = self._clock()
        if now - self._beaten < ASK_S:
            return None
        with self._lock:
            self._number += 1
            self._asked = {number: asked for number, asked in self._asked.items() if now - asked < ASSURED_S}
            self._asked[self._number] = now
            number = self._number
        executing = self._executor.executing() if self._executor is not None else []
        return {"number": number, "tests_at_a_time": self._tests_at_a_time, "executing": executing}

    def answer(self, told: dict[str, Any]) -> None:
        """Take the answer of a web service: it knows that this worker lives, and which jobs are to stop."""
        with self._lock:
            asked = self._asked.get(told.get("number", 0))
        if asked is not None:
            self._answered = max(self._answered, asked)
        for one in told.get("stop", []):
            if self._executor is not None:
                self._executor.stop(str(one["id"]), int(one["attempt"]))

    def _keep(self, executor: Executing) -> None:
        while True:
            left = self.left_s
            if left > 0:
                executor.assure(left)
            time.sleep(LOOK_S)
