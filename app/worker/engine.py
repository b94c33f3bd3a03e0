"""The engine's own process: executes one test at a time, tells of it through a pipe, and ends with its worker."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from app.live.frames import Decimator, bucket_size
from app.live.messages import progress, schema

CHUNK_S = 0.02  # wall time between looks at the pipe
PROGRESS_S = 0.1


@dataclass(frozen=True, slots=True)
class Job:
    """One execution of a run: its plan, where its recording goes, and where the laboratory's records are."""

    run_id: str
    attempt: int
    plan: dict[str, Any]
    recording: Path
    motions: Path


@dataclass(frozen=True, slots=True)
class Cancel:
    """A request to stop one run; it may come when that run has just ended, and then means nothing."""

    run_id: str


@dataclass(frozen=True, slots=True)
class Ready:
    """The engine is compiled and takes jobs."""


@dataclass(frozen=True, slots=True)
class Stopping:
    """The engine's answer to Cancel: the test stands still, what was recorded is being saved."""


@dataclass(frozen=True, slots=True)
class Done:
    """The run's summary, and checksum and size of its recording."""

    summary: dict[str, Any]
    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Failed:
    """Why the test could not be executed."""

    reason: str


def serve(pipe: Connection) -> None:
    """Execute jobs until the worker is gone."""
    from rths_engine.running.warm import warm

    warm()
    try:
        pipe.send(Ready())
        while True:
            job = pipe.recv()
            if isinstance(job, Cancel):
                continue
            try:
                outcome: Done | Failed = _execute(job, pipe)
            except (EOFError, ConnectionError):
                return
            except Exception as error:
                outcome = Failed(f"{type(error).__name__}: {error}")
            pipe.send(outcome)
    except (EOFError, ConnectionError, KeyboardInterrupt):
        return


def _execute(job: Job, pipe: Connection) -> Done | Failed:
    from rths_engine.foundation.errors import RthsError
    from rths_engine.parts.ground_motions import MotionLibrary
    from rths_engine.planning.reading import read_plan
    from rths_engine.recordings.run_file import save
    from rths_engine.running.run import Run

    try:
        plan = read_plan(job.plan)
        run = Run(plan, MotionLibrary(job.motions))
    except RthsError as error:
        return Failed(str(error))
    telling = _Telling(run, job, pipe)
    cancelled = telling.run_to_end()
    status = "cancelled" if cancelled else "tripped" if run.trip else "completed"
    result = run.result(status, telling.elapsed)
    saved = save(job.recording, result)
    return Done(result.summary(), saved.sha256, saved.size)


class _Telling:
    """Advances a run in chunks at its pace, sends frames and progress, and looks for a cancel between chunks."""

    def __init__(self, run: Any, job: Job, pipe: Connection):
        from rths_engine.results.metrics import RunningMeasures

        self.run, self.job, self.pipe = run, job, pipe
        self.elapsed, self.measured = 0.0, 0
        self.measures = RunningMeasures(run.plan, run.channels, run.history[0, 0])
        bucket = bucket_size(run.total)
        self.decimator = Decimator(run.channels, bucket)
        pipe.send(schema(job.attempt, run.dt, bucket, run.total, run.channels))

    def run_to_end(self) -> bool:
        """True when the test was cancelled."""
        pace = self.run.plan.pace
        factor = pace.factor if pace.kind == "real_time" else math.inf
        dt_step = self.run.plan.step
        chunk = max(1, round(CHUNK_S * factor / dt_step)) if math.isfinite(factor) else 16
        start, told = time.perf_counter(), -PROGRESS_S
        while not self.run.finished:
            if self.pipe.poll(self._wait(start, factor)):
                if self.pipe.recv() != Cancel(self.job.run_id):
                    continue
                self.pipe.send(Stopping())
                self._tell(time.perf_counter() - start, ended=True)
                return True
            begun = time.perf_counter()
            self.run.advance(chunk)
            now = time.perf_counter()
            if math.isinf(factor):
                chunk = max(1, round(chunk * min(4.0, CHUNK_S / max(now - begun, 1e-6))))
            if now - start - told >= PROGRESS_S or self.run.finished:
                told = now - start
                self._tell(told, ended=self.run.finished)
            else:
                self._frame(ended=False)
        return False

    def _wait(self, start: float, factor: float) -> float:
        """Seconds until the wall clock has come to where the test is."""
        due: float = self.run.done * self.run.dt / factor
        return max(0.0, due - (time.perf_counter() - start))

    def _tell(self, elapsed: float, ended: bool) -> None:
        self.elapsed = elapsed
        self._frame(ended)
        done, dt = self.run.done, self.run.dt
        self.measures.take(self.run.signals[self.measured : done])
        self.measured = done
        self.pipe.send(progress("running", done * dt, elapsed, self.run.total * dt, self.measures.shown()))

    def _frame(self, ended: bool) -> None:
        frame = self.decimator.frame(self.run.signals, self.run.done, ended)
        if frame is not None:
            self.pipe.send(frame)
