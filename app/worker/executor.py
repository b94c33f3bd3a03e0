"""What a worker does with one run: start it in the database, execute it, store it once."""

from __future__ import annotations

import os
import threading
import time

from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings
from app.db import unit_of_work
from app.runs.repository import RunRepository
from app.runs.service import Outcome, RunService
from app.worker.engine import Done, Job
from app.worker.link import Link
from app.worker.pool import EngineProcess, Pool
from rths_engine.ground_motions import MotionLibrary

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
        """Execute a run to its end. Does nothing for one that has ended or was cancelled meanwhile."""
        self._wait_while_held()
        job = self._start(run_id)
        if job is None:
            return
        engine = self.pool.take()
        with self._lock:
            self.running[run_id] = engine
        telling = self.link.open(run_id, job.attempt)
        try:
            outcome = engine.execute(job, telling.take)
            if isinstance(outcome, Done):
                self._store(job, outcome)
            else:
                with unit_of_work(self.maker) as session:
                    RunService(session, self.motions).fail(run_id, outcome.reason)
        finally:
            with self._lock:
                del self.running[run_id]
            job.recording.unlink(missing_ok=True)
            telling.ended = True
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
        for stray in self.settings.recordings.glob(f".{run_id}.*"):
            stray.unlink(missing_ok=True)
        with unit_of_work(self.maker) as session:
            run = RunService(session, self.motions).start(run_id, self.name)
            if run is None:
                return None
            recording = self.settings.recordings / f".{run_id}.{run.attempt}.h5"
            return Job(run_id, run.attempt, run.plan, recording.resolve(), self.settings.motions.resolve())

    def _store(self, job: Job, done: Done) -> None:
        """Put the recording in its place and commit its checksum with the measures: both or, at the next attempt, again."""
        outcome = Outcome(done.summary, done.sha256, done.size)
        with unit_of_work(self.maker) as session:
            if RunService(session, self.motions).finish(job.run_id, outcome):
                session.flush()
                os.replace(job.recording, self.settings.recordings / f"{job.run_id}.h5")
