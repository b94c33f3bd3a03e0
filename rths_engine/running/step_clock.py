"""The clock of a loop that Python executes: each controller step starts at its time, and a lost period stays lost."""

from __future__ import annotations

import time
from typing import Any

# chosen; see docs/decisions/0023
AWAKE_S = 0.0004  # before the start of a step, in which the clock is watched instead of slept over


class StepClock:
    """Times of controller steps, `period` seconds of wall time apart; 0: no clock.

    A step that starts more than a period late shifts all later steps. Delays and lengths (ns) are measured as those of a loop
    without external rigs (`results.timing`): a delay is from the due time before it was shifted.
    """

    def __init__(self, period: float, delays: Any = None, lengths: Any = None):
        self.period, self._delays, self._lengths = period, delays, lengths
        self._due: float | None = None
        self._late = self.begun = 0.0

    def wait(self) -> None:
        """Wait for the start of the next step."""
        if not self.period:
            return
        now = time.perf_counter()
        due = now if self._due is None else self._due + self.period
        if due - now > AWAKE_S:
            time.sleep(due - now - AWAKE_S)
        self.begun = time.perf_counter()
        while self.begun < due:
            self.begun = time.perf_counter()
        self._late = self.begun - due
        self._due = self.begun if self._late > self.period else due

    def end(self, done: int) -> None:
        """Measure controller step `done`, counted from 0, whose work ends now."""
        if self._delays is not None:
            self._delays[done] = 1e9 * self._late
            self._lengths[done] = 1e9 * (time.perf_counter() - self.begun)
