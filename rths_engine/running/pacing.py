"""Pacing of controller steps: wait for the due time of each, and measure when it begins and how long it takes.

Controller step k, counted from 0, is due k periods after the start. Where its work ends after step k + 1 is due, it has missed
its deadline. The next steps then begin at once, without a wait, until the loop is in time again: due times stay where they are
and no step is left out.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.kernel import compiled, piece
from rths_engine.running.clock import now, sleep

STOP, DONE, START = range(3)  # of `control`
STOPPED = -1  # what a loop returns that was asked to stop
LEAD = 2_000_000  # ns between the start of the loop and its first due time; chosen; see docs/decisions/0023


class Pacing(NamedTuple):
    """How the controller steps of a run are paced, and what is measured of them. A period of 0 runs as fast as possible."""

    period: float  # ns
    spin: int  # ns before a due time in which the loop waits awake
    control: Any  # (3): a request to stop, the steps done, the start (ns)
    delays: Any  # (Q), ns from the due time of each step to its begin
    lengths: Any  # (Q), ns from its begin to the end of its work
    spec: Any  # (2), memory of the clock


def pacing(period: float, spin: int, steps: int) -> Pacing:
    """The pacing of `steps` controller steps, each `period` (ns) after the other."""
    delays, lengths = np.zeros((2, steps), dtype=np.float32)
    return Pacing(float(period), spin, np.zeros(3, dtype=np.int64), delays, lengths, np.zeros(2, dtype=np.int64))


UNPACED = pacing(0, 0, 0)


@compiled
def _awake_at(due, spin, spec):
    """Wait for a due time (ns), the last `spin` ns awake. Returns the time (ns)."""
    time = now(spec)
    if due - spin > time:
        sleep(due - spin, spec)
        time = now(spec)
    while time < due:
        time = now(spec)
    return time


@piece
def start(pacing: Pacing) -> None:
    """Set the due time of the first step."""
    pacing.control[START] = now(pacing.spec) + LEAD


@piece
def await_step(k: int, pacing: Pacing) -> None:
    """Wait for the due time of controller step k and measure how late the step begins."""
    due = pacing.control[START] + int(k * pacing.period)
    pacing.delays[k] = _awake_at(due, pacing.spin, pacing.spec) - due


@piece
def end_step(k: int, pacing: Pacing) -> bool:
    """Measure the length of controller step k and make its row known. Returns whether the loop is asked to stop."""
    due = pacing.control[START] + int(k * pacing.period)
    pacing.lengths[k] = now(pacing.spec) - due - pacing.delays[k]
    pacing.control[DONE] = k + 1
    return pacing.control[STOP] != 0
