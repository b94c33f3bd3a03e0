"""A run in real time: its loop in a thread of its own, outside the interpreter lock, and the timing of its steps."""

from __future__ import annotations

import threading

from rths_engine.planning.plan import RealTime
from rths_engine.results.running_timing import RunningTiming
from rths_engine.results.timing import Granted, Timing
from rths_engine.running.pacing import DONE, STOP, pacing
from rths_engine.running.rights import granted
from rths_engine.running.run import Run

# chosen; see docs/decisions/0023
SPIN = 50_000  # ns before a due time in which a loop with real-time priority waits awake
SPIN_SHARE = 0.1  # of the period, the most that a loop waits awake


class PacedRun:
    """Runs a test at a pace. The thread that made it takes the rows with `take`, and may `stop` the loop within one step."""

    def __init__(self, run: Run, pace: RealTime):
        self.run, self.pace = run, pace
        self.rate = run.plan.controller_rate * pace.factor
        period = 1e9 / self.rate
        spin = min(SPIN, int(SPIN_SHARE * period)) if pace.priority is not None else 0
        self._pacing = pacing(period, spin, run.total)
        self._granted: Granted | None = None
        self._error: BaseException | None = None
        self._measured = run.measured = RunningTiming(self.rate, run.dt)
        run.touch()
        for array in (self._pacing.delays, self._pacing.lengths):
            array.fill(0.0)
        self._thread = threading.Thread(target=self._execute, daemon=True, name="rths-paced")

    def start(self) -> None:
        """Start the loop."""
        self._thread.start()

    def stop(self) -> None:
        """Ask the loop to stop after its present step, and wait for it."""
        self._pacing.control[STOP] = 1
        self._thread.join()

    def take(self, within_s: float = 0.0) -> bool:
        """Take the rows and times of the steps that are done, after a wait of at most `within_s`. Returns whether it ended."""
        self._thread.join(within_s)
        ended = not self._thread.is_alive()
        if self._error is not None:
            raise self._error
        new = self.run.take(int(self._pacing.control[DONE]))
        self._measured.take(self._pacing.delays[new], self._pacing.lengths[new])
        if ended:
            done = self.run.done
            self.run.timing = Timing(
                self.rate, self.run.dt, self._pacing.delays[:done], self._pacing.lengths[:done], self._granted or Granted()
            )
        return ended

    def _execute(self) -> None:
        try:
            with granted(self.pace) as self._granted:
                self.run.run_paced(self._pacing)
        except BaseException as error:
            self._error = error
