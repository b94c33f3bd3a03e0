"""The clock of a loop that Python executes: each controller step starts at its time, and no two steps closer than a period."""

from __future__ import annotations

import time

import numpy as np

# chosen; see docs/decisions/0023
AWAKE_S = 0.0004  # before the start of a step, in which the clock is watched instead of slept over


class StepClock:
    """Times of `steps` controller steps, `period` seconds of wall time apart; 0: no clock.

    A step that starts more than a period late shifts all later steps. `shifted` counts the periods that were lost so.
    `delays` and `lengths` (ns) of the steps are measured as those of a loop without external rigs (`results.timing`).
    """

    def __init__(self, period: float, steps: int):
        self.period, self.shifted = period, 0
        self.delays, self.lengths = np.zeros((2, steps if period else 0), dtype=np.float32)
        self._due: float | None = None
        self._begun = 0.0

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
        self._begun = time.perf_counter()
        while self._begun < self._due:
            self._begun = time.perf_counter()

    def end(self, done: int) -> None:
        """Measure controller step `done`, counted from 0, whose work ends now."""
        if self._due is not None:
            self.delays[done] = 1e9 * (self._begun - self._due)
            self.lengths[done] = 1e9 * (time.perf_counter() - self._begun)
