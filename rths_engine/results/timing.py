"""The deadlines of a test in real time: when each controller step began and how long it took.

Step k is due at k periods. Its *delay* is the time from then to its begin; its *length* is the time from its begin to the end
of its work. It misses its deadline where delay + length > period: its work ends after the next step is due. It begins late
where its delay exceeds a tenth of the period. After a missed deadline the next steps begin at once until the loop is in time.

A step would have met another rate where its own delay + length are within the period of that rate. Its own delay is the delay
without the part that an earlier missed step caused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.float32]

# chosen; see docs/decisions/0023
LATE = 0.1  # of the period
RATES = (1024.0, 2048.0, 4096.0)  # Hz, of the verdicts

# by definition: 1, 2 and 5 of each decade, from 1 us to 500 ms
EDGES_US = tuple(round(mantissa * 10.0**decade) for decade in range(6) for mantissa in (1, 2, 5))

PERCENTILES = {"p50": 50.0, "p99": 99.0, "p999": 99.9, "max": 100.0}  # by definition of the names


@dataclass(frozen=True, slots=True)
class Granted:
    """What was asked of the operating system for the loop, what it granted, and what it refused, in sentences."""

    core_asked: int | None = None
    core: int | None = None
    priority_asked: int | None = None
    priority: int | None = None
    memory_locked: bool = False
    refused: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        return {
            "core_asked": self.core_asked,
            "core": self.core,
            "priority_asked": self.priority_asked,
            "priority": self.priority,
            "memory_locked": self.memory_locked,
            "refused": list(self.refused),
        }


@dataclass(frozen=True, slots=True)
class Timing:
    """Delays and lengths (ns) of the controller steps of a run at `rate` (steps/s of wall time); `dt` (s) of test time."""

    rate: float
    dt: float
    delays: Times
    lengths: Times
    granted: Granted

    def summary(self) -> dict[str, Any]:
        """JSON form: counts, the worst step, percentiles, histograms and verdicts."""
        period = 1e9 / self.rate
        spent = self.delays.astype(np.float64) + self.lengths
        own = spent - caught_up(spent, period)
        return {
            "rate_hz": self.rate,
            "period_us": period / 1e3,
            "steps": len(spent),
            "missed": int((spent > period).sum()),
            "late": int((self.delays > LATE * period).sum()),
            "worst": worst(spent, self.delays, self.lengths, period, self.dt),
            "delay_us": _percentiles(self.delays),
            "length_us": _percentiles(self.lengths),
            "histogram": {
                "edges_us": list(EDGES_US),
                "delay": counted(self.delays).tolist(),
                "length": counted(self.lengths).tolist(),
            },
            "verdicts": [_verdict(rate, own) for rate in RATES],
            "granted": self.granted.as_dict(),
        }


def caught_up(spent: NDArray[np.float64], period: float) -> NDArray[np.float64]:
    """The part (ns) of the delay of each step that the overrun of the step before it caused."""
    found = np.zeros_like(spent)
    found[1:] = np.maximum(0.0, spent[:-1] - period)
    return found


def counted(times: Times) -> NDArray[np.int64]:
    """The number of times (ns) below the first edge, between each two edges, and from the last edge on."""
    places = np.searchsorted(np.array(EDGES_US) * 1e3, times, side="right")
    return np.bincount(places, minlength=len(EDGES_US) + 1)


def worst(
    spent: NDArray[np.float64], delays: Times, lengths: Times, period: float, dt: float, first: int = 0
) -> dict[str, Any] | None:
    """The step with the largest delay + length; step `first` is the first of the arrays. None without steps."""
    if not len(spent):
        return None
    at = int(np.argmax(spent))
    return {
        "step": first + at + 1,
        "time_s": (first + at + 1) * dt,
        "delay_us": float(delays[at]) / 1e3,
        "length_us": float(lengths[at]) / 1e3,
        "share": float(spent[at]) / period,
    }


def _percentiles(times: Times) -> dict[str, float | None]:
    if not len(times):
        return dict.fromkeys(PERCENTILES)
    values = np.percentile(times, list(PERCENTILES.values())) / 1e3
    return dict(zip(PERCENTILES, values.tolist(), strict=True))


def _verdict(rate: float, own: NDArray[np.float64]) -> dict[str, Any]:
    missed = int((own > 1e9 / rate).sum())
    return {"rate_hz": rate, "missed": missed, "met": missed == 0 and len(own) > 0}
