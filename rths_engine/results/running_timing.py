"""The deadlines of a test while it runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.results.timing import EDGES_US, LATE, Times, counted, worst


class RunningTiming:
    """Takes the delays and lengths (ns) of each new part of the controller steps, in order."""

    def __init__(self, rate: float, dt: float):
        self.rate, self._dt = rate, dt
        self._period = 1e9 / rate
        self._steps = self._missed = self._late = 0
        self._worst: dict[str, Any] | None = None
        self._delays, self._lengths = counted(np.zeros(0, dtype=np.float32)), counted(np.zeros(0, dtype=np.float32))

    def take(self, delays: Times, lengths: Times) -> None:
        if not len(delays):
            return
        spent = delays.astype(np.float64) + lengths
        self._missed += int((spent > self._period).sum())
        self._late += int((delays > LATE * self._period).sum())
        found = worst(spent, delays, lengths, self._period, self._dt, self._steps)
        if found and (self._worst is None or found["share"] > self._worst["share"]):
            self._worst = found
        self._delays, self._lengths = self._delays + counted(delays), self._lengths + counted(lengths)
        self._steps += len(spent)

    def shown(self) -> dict[str, Any]:
        """JSON form, as in a run's summary but without percentiles, verdicts and rights."""
        return {
            "rate_hz": self.rate,
            "period_us": self._period / 1e3,
            "steps": self._steps,
            "missed": self._missed,
            "late": self._late,
            "worst": self._worst,
            "histogram": {"edges_us": list(EDGES_US), "delay": self._delays.tolist(), "length": self._lengths.tolist()},
        }
