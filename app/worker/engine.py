"""The engine process: executes one test at a time and sends frames and progress to its worker."""

from __future__ import annotations

import time
from contextlib import ExitStack

from app.runs.order import Outcome, RunOrder, digest_of, is_approved
from app.worker import client
from app.worker.child import Line, Refused
from app.worker.room import room_for
from app.worker.viewers import Viewers

CHUNK_S = 0.02  # wall time between two checks for a cancel
PROGRESS_S = 0.1


def prepare() -> None:
    """Compile the engine, or load the compiled code from the cache."""
    from rths_engine.running.warm import warm

    warm()


def execute(order: RunOrder, line: Line) -> Outcome:
    """Execute a run and save its recording. Raises Refused if its plan cannot be executed."""
    from app.store.motions import fmus_of, motions_of
    from rths_engine.foundation.errors import RthsError
    from rths_engine.planning.reading import read_model
    from rths_engine.recordings.run_file import save
    from rths_engine.running.opening import opened

    if order.approved:
        _check_approved(order)
    if order.plan.get("test") == "client":
        return client.execute(order, line)
    with ExitStack() as room, ExitStack() as rigs:
        try:
            run = rigs.enter_context(opened(read_model(order.plan), motions_of(order.settings), fmus_of(order.settings)))
        except RthsError as error:
            raise Refused(str(error)) from None
        release = room.enter_context(room_for(run, order.recording))
        telling = _Telling(run, order.attempt, line)
        cancelled = telling.run_to_end()
        rigs.close()
        status = "cancelled" if cancelled else "tripped" if run.trip else "completed"
        result = run.result(status, telling.elapsed)
        release()
        saved = save(order.recording, result)
    return Outcome(result.summary(), saved.sha256, saved.size)


def _check_approved(order: RunOrder) -> None:
    """Raise Refused unless the plan is the one that was approved."""
    if not is_approved(order.plan, order.approved):
        digest = digest_of(order.plan)
        raise Refused(f"The plan is not the one that was approved: its digest is {digest}, approved was {order.approved}.")


class _Telling(Viewers):
    """Runs a test at its pace, sends frames and progress, and stops it when it is cancelled."""

    def run_to_end(self) -> bool:
        """Run the test to its end or until it is cancelled; returns whether it was cancelled."""
        self._start, self._told = time.perf_counter(), -PROGRESS_S
        if self.run.plan.pace.kind == "real_time":
            return self._in_real_time()
        return self._in_parts()

    def _in_real_time(self) -> bool:
        """Follow the loop, which runs in a thread of its own and waits for nothing here."""
        from rths_engine.running.paced import PacedRun

        paced = PacedRun(self.run, self.run.plan.pace)
        paced.start()
        self.line.stop_machine = paced.stop
        ended = False
        while not ended:
            cancelled = self.line.cancelled(within_s=CHUNK_S)
            if cancelled:
                paced.stop()
                self.line.stopping()
            ended = paced.take()
            self._follow(ended)
        return cancelled and not self.run.finished

    def _in_parts(self) -> bool:
        """Advance the test in parts of about CHUNK_S: as fast as possible."""
        chunk = 16
        while not self.run.finished:
            if self.line.cancelled(within_s=0.0):
                self.line.stopping()
                self._tell(time.perf_counter() - self._start, ended=True)
                return True
            begun = time.perf_counter()
            self.run.advance(chunk)
            chunk = max(1, round(chunk * min(4.0, CHUNK_S / max(time.perf_counter() - begun, 1e-6))))
            self._follow(self.run.finished)
        return False

    def _follow(self, ended: bool) -> None:
        """Send the new frames, and the progress from time to time."""
        elapsed = time.perf_counter() - self._start
        if elapsed - self._told >= PROGRESS_S or ended:
            self._told = elapsed
            self._tell(elapsed, ended)
        else:
            self.frame(ended=False)

    def _tell(self, elapsed: float, ended: bool) -> None:
        timing = {"timing": self.run.measured.shown()} if self.run.measured else {}
        self.tell(elapsed, ended, **timing)
