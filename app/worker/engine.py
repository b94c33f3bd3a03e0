"""The engine process: executes one test at a time and sends frames and progress to its worker."""

from __future__ import annotations

import math
import time
from contextlib import ExitStack

from app.runs.order import Outcome, RunOrder
from app.worker import client
from app.worker.child import Line, Refused
from app.worker.viewers import Viewers

CHUNK_S = 0.02  # wall time between two checks for a cancel
PROGRESS_S = 0.1


def prepare() -> None:
    """Compile the engine, or load the compiled code from the cache."""
    from rths_engine.running.warm import warm

    warm()


def execute(order: RunOrder, line: Line) -> Outcome:
    """Execute a run and save its recording. Raises Refused if its plan cannot be executed."""
    from rths_engine.foundation.errors import RthsError
    from rths_engine.parts.ground_motions import MotionLibrary
    from rths_engine.planning.reading import read_model
    from rths_engine.recordings.run_file import save
    from rths_engine.running.opening import opened

    if order.plan.get("test") == "client":
        return client.execute(order, line)
    with ExitStack() as rigs:
        try:
            run = rigs.enter_context(opened(read_model(order.plan), MotionLibrary(order.motions), order.fmus))
        except RthsError as error:
            raise Refused(str(error)) from None
        telling = _Telling(run, order.attempt, line)
        cancelled = telling.run_to_end()
    status = "cancelled" if cancelled else "tripped" if run.trip else "completed"
    result = run.result(status, telling.elapsed)
    saved = save(order.recording, result)
    return Outcome(result.summary(), saved.sha256, saved.size)


class _Telling(Viewers):
    """Advances a run in chunks at its pace, sends frames and progress, and checks for a cancel between chunks."""

    def run_to_end(self) -> bool:
        """Run the test to its end or until it is cancelled; returns whether it was cancelled."""
        pace = self.run.plan.pace
        factor = pace.factor if pace.kind == "real_time" else math.inf
        dt_step = self.run.plan.step
        chunk = max(1, round(CHUNK_S * factor / dt_step)) if math.isfinite(factor) else 16
        start, told = time.perf_counter(), -PROGRESS_S
        while not self.run.finished:
            if self.line.cancelled(within_s=self._wait(start, factor)):
                self.line.stopping()
                self.tell(time.perf_counter() - start, ended=True)
                return True
            begun = time.perf_counter()
            self.run.advance(chunk)
            now = time.perf_counter()
            if math.isinf(factor):
                chunk = max(1, round(chunk * min(4.0, CHUNK_S / max(now - begun, 1e-6))))
            if now - start - told >= PROGRESS_S or self.run.finished:
                told = now - start
                self.tell(told, ended=self.run.finished)
            else:
                self.frame(ended=False)
        return False

    def _wait(self, start: float, factor: float) -> float:
        """Seconds until the wall clock reaches the time of the test."""
        due: float = self.run.done * self.run.dt / factor
        return max(0.0, due - (time.perf_counter() - start))
