"""What a worker does with one diagnosis: start it in the database, do it in a process of its own, store its result once."""

from __future__ import annotations

import multiprocessing
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings
from app.db import unit_of_work
from app.diagnoses.sources import file_of
from app.diagnoses.work import DiagnosisWork
from app.worker.diagnosis import DiagnosisJob, Found, Progress, Undone, serve

LOOK_S = 0.2  # between looks for a cancel
PATIENCE_S = 5.0


class Cancelled(Exception):
    """Someone asked to stop the diagnosis."""


class Diagnoser:
    def __init__(self, settings: Settings, maker: sessionmaker[Session], name: str):
        self.settings, self.maker, self.name = settings, maker, name

    def execute(self, diagnosis_id: str) -> None:
        """Do a diagnosis to its end. Does nothing for one that has ended or was cancelled meanwhile."""
        job = self._start(diagnosis_id)
        if job is None:
            return
        try:
            told = self._follow(job)
        except Cancelled:
            with unit_of_work(self.maker) as session:
                DiagnosisWork(session).stop(job.diagnosis_id, job.attempt)
            return
        with unit_of_work(self.maker) as session:
            work = DiagnosisWork(session)
            if isinstance(told, Found):
                work.finish(job.diagnosis_id, job.attempt, told.verdict, told.pictures)
            else:
                work.fail(job.diagnosis_id, job.attempt, told.reason)

    def _start(self, diagnosis_id: str) -> DiagnosisJob | None:
        with unit_of_work(self.maker) as session:
            started = DiagnosisWork(session).start(diagnosis_id, self.name)
            if started is None:
                return None
            one = started.diagnosis
            first, *others = [file_of(given, self.settings).resolve() for given in one.inputs]
            return DiagnosisJob(one.id, started.attempt, started.plan, first, tuple(others), one.level)

    def _follow(self, job: DiagnosisJob) -> Found | Undone:
        """Raises Cancelled; however it ends, its process has ended too."""
        context = multiprocessing.get_context("spawn")
        pipe, theirs = context.Pipe()
        process = context.Process(target=serve, args=(theirs, job), daemon=True, name="rths-diagnosis")
        process.start()
        theirs.close()
        try:
            return self._told(job, pipe, process)
        finally:
            process.kill()
            process.join(PATIENCE_S)
            pipe.close()

    def _told(self, job: DiagnosisJob, pipe: Connection, process: BaseProcess) -> Found | Undone:
        while True:
            if self._cancel_requested(job):
                raise Cancelled
            if not pipe.poll(LOOK_S):
                continue
            try:
                told = pipe.recv()
            except (EOFError, OSError):
                process.join(PATIENCE_S)
                return Undone(f"The process of the diagnosis ended unexpectedly (exit code {process.exitcode}).")
            if isinstance(told, Found | Undone):
                return told
            self._tell(job, told)

    def _cancel_requested(self, job: DiagnosisJob) -> bool:
        with unit_of_work(self.maker) as session:
            return DiagnosisWork(session).cancel_requested(job.diagnosis_id)

    def _tell(self, job: DiagnosisJob, told: Progress) -> None:
        with unit_of_work(self.maker) as session:
            DiagnosisWork(session).tell(job.diagnosis_id, job.attempt, told.doing, told.share)
