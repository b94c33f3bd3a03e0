"""The clock of a loop that Python executes: each controller step starts at its time, and no two steps closer than a period."""

from __future__ import annotations

import time

# chosen; see docs/decisions/0023
AWAKE_S = 0.0004  # before the start of a step, in which the clock is watched instead of slept over


class StepClock:
    """Times of controller steps, `period` seconds of wall time apart; 0: no clock.

    A step that starts more than a period late shifts all later steps. `shifted` counts the periods that were lost so.
    """

    def __init__(self, period: float):
        self.period, self.shifted = period, 0
        self._due: float | None = None

    def wait(self) -> None:
        """Wait for the start of the next step."""
        if not self.period:
            return
        now = time.perf_counter()
        self._due = now if self._due is None else self._due + self.period
        if now - self._due > self.period:
            self.shifted += int((now - self._due) / self.period)
            self._due = now
        if self._due - now > AWAKE_S:
            time.sleep(self._due - now - AWAKE_S)
        while time.perf_counter() < self._due:
            pass
