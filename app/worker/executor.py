"""What a worker does with one run: start it in the database, execute it, store it once."""

from __future__ import annotations

import logging
import os
import threading
import time

from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings
from app.db import unit_of_work
from app.models import Run
from app.runs.repository import RunRepository
from app.runs.service import Outcome, RunService
from app.worker.engine import Done, Job
from app.worker.link import Link
from app.worker.pool import EngineDied, EngineProcess, Pool
from rths_engine.parts.ground_motions import MotionLibrary

log = logging.getLogger("rths.worker")
HOLD_POLL_S = 0.1


class Executor:
    """Executes runs in engine processes. `running` says which engine works on which run."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], link: Link, name: str):
        self.settings, self.maker, self.link, self.name = settings, maker, link, name
        self.motions = MotionLibrary(settings.motions)
        self.pool = Pool(settings.worker_concurrency)
        self.running: dict[str, EngineProcess] = {}
        self._lock = threading.Lock()

    def execute(self, run_id: str) -> None:
        """Execute a run to its end, again where its engine dies; one that has ended or was cancelled is left alone."""
        try:
            self._attempt(run_id)
        except EngineDied as died:
            log.warning("the engine died (%s) over run %s", died, run_id)
            self.execute(run_id)

    def _attempt(self, run_id: str) -> None:
        engine = self.pool.take()
        try:
            self._wait_while_held()
            job = self._start(run_id)
            if job is not None:
                self._execute(job, engine)
        finally:
            self.pool.give(engine)

    def cancel_requested(self) -> None:
        """Stop the running tests that someone asked to stop."""
        with self._lock:
            running = dict(self.running)
        if running:
            with unit_of_work(self.maker) as session:
                asked = RunRepository(session).cancel_requested(list(running))
            for run_id in asked:
                running[run_id].cancel()

    def _wait_while_held(self) -> None:
        while True:
            with unit_of_work(self.maker) as session:
                if not RunRepository(session).held():
                    return
            time.sleep(HOLD_POLL_S)

    def _start(self, run_id: str) -> Job | None:
        with unit_of_work(self.maker) as session:
            started = RunService(session, self.motions).start(run_id, self.name)
            run = started or RunRepository(session).get(run_id)
            if run is None:
                return None
            self._sweep(run)
            if started is None:
                self.link.open(run_id, run.attempt).ended = True
                return None
            recording = self.settings.recordings / f".{run_id}.{run.attempt}.h5"
            return Job(run_id, run.attempt, run.plan, recording.resolve(), self.settings.motions.resolve())

    def _sweep(self, run: Run) -> None:
        """Remove what earlier attempts left. The caller has locked the run, so none of it is being committed."""
        for path in self.settings.recordings.glob(f"*{run.id}*"):
            if not (run.recording_sha256 and path.name == f"{run.id}.h5"):
                path.unlink(missing_ok=True)

    def _execute(self, job: Job, engine: EngineProcess) -> None:
        with self._lock:
            self.running[job.run_id] = engine
        telling = self.link.open(job.run_id, job.attempt)
        try:
            outcome = engine.execute(job, telling.take)
            if isinstance(outcome, Done):
                self._store(job, outcome)
            else:
                self._fail(job, outcome.reason)
        except OSError as error:
            self._fail(job, f"Its recording could not be stored: {error.strerror or error}.")
        finally:
            with self._lock:
                del self.running[job.run_id]
            job.recording.unlink(missing_ok=True)
            telling.ended = True

    def _store(self, job: Job, done: Done) -> None:
        """Put the recording in its place and commit its checksum with the measures: both or, at the next attempt, again."""
        outcome = Outcome(done.summary, done.sha256, done.size)
        with unit_of_work(self.maker) as session:
            if RunService(session, self.motions).finish(job.run_id, outcome):
                session.flush()
                os.replace(job.recording, self.settings.recordings / f"{job.run_id}.h5")

    def _fail(self, job: Job, reason: str) -> None:
        """End the run as failed, unless another worker has taken it up meanwhile."""
        with unit_of_work(self.maker) as session:
            run = RunRepository(session).locked(job.run_id)
            if run is not None and run.attempt == job.attempt:
                RunService(session, self.motions).fail(job.run_id, reason)
