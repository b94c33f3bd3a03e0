"""How long the steps of a client took."""

from __future__ import annotations

import time
from array import array

import numpy as np


class StepTimes:
    """Wall time of every step of a client, from the end of the step before to its own end."""

    def __init__(self) -> None:
        self._taken = array("d")
        self._last: float | None = None

    def ended(self) -> None:
        """Note that a step ends now."""
        now = time.perf_counter()
        if self._last is not None:
            self._taken.append(now - self._last)
        self._last = now

    def as_dict(self, last: int = 0) -> dict[str, float | None]:
        """Median, 95th percentile and longest of all steps, or of the `last` ones, in ms; None for fewer than two steps."""
        if not self._taken:
            return {"median": None, "p95": None, "longest": None}
        median, p95, longest = np.percentile(self._taken[-last:], (50, 95, 100)) * 1e3
        return {"median": float(median), "p95": float(p95), "longest": float(longest)}
