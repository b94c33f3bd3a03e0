"""The rig as a client sees it: it moves to a displacement within a number of controller steps, and is measured at the end."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence

import numpy as np

from rths_engine.client.ended import Ended
from rths_engine.foundation.arrays import Array
from rths_engine.running.client_run import ClientRun

# chosen; see docs/decisions/0023
CHUNK_STEPS = 4096  # controller steps between two looks, as fast as possible


class Rig:
    """Moves a run at the pace of its plan. `look` is called between parts of a motion; it raises Ended to stop the rig.

    `waits` counts the ramps that began more than a controller step after the end of the ramp before, because the client had
    not sent its displacement, and `longest_wait` (s) is the longest of these times. Both belong to a test in real time.
    """

    def __init__(self, run: ClientRun, look: Callable[[], None]):
        pace = run.plan.pace
        self.run, self._look = run, look
        self._step_s = run.dt / pace.factor if pace.kind == "real_time" else 0.0
        self._due = math.inf
        self.waits, self.longest_wait = 0, 0.0

    def move(self, target: Sequence[float], steps: int) -> None:
        """Move to `target` (m). Raises Ended where the test would get too long, or a limit trips."""
        run = self.run
        if run.done + steps > run.total:
            longest = f"{run.total * run.dt:g} s"
            raise Ended(
                f"The client went beyond the longest duration of {longest}. Give the plan a longer duration.", cause="duration"
            )
        run.ramp(target, steps)
        if self._step_s:
            self._paced(steps)
        else:
            run.advance(CHUNK_STEPS)
            while run.moving:
                self._look()
                run.advance(CHUNK_STEPS)
        if run.trip is not None:
            raise Ended(run.trip.sentence, cause="limit")

    def rate(self, order: int) -> Array:
        """The derivative of the measured displacement (m/s, m/s^2) by differences of the last controller steps."""
        run = self.run
        columns = [k for k, channel in enumerate(run.channels) if channel.role == "x_meas"]
        rows = np.zeros((order + 1, len(columns)))  # every test starts from rest
        kept = min(run.done, order + 1)
        rows[order + 1 - kept :] = run.signals[run.done - kept : run.done, columns]
        found: Array = np.diff(rows, order, axis=0)[0] / run.dt**order
        return found

    def _paced(self, steps: int) -> None:
        run, step_s = self.run, self._step_s
        start = time.perf_counter()
        wait = start - self._due
        if wait > step_s:
            self.waits, self.longest_wait = self.waits + 1, max(self.longest_wait, wait)
        else:
            start = min(self._due, start)
        for k in range(1, steps + 1):
            ahead = start + k * step_s - time.perf_counter()
            if ahead > 0:
                time.sleep(ahead)
            run.advance(1)
            self._look()
            if run.trip is not None:
                return
        self._due = start + steps * step_s
