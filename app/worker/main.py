"""A worker: takes tests and diagnoses from their queues. `python -m app.worker` starts one anywhere with the same database."""

from __future__ import annotations

import argparse
import logging
import os
import signal
import socket
import sys
import threading
import time
from datetime import UTC, datetime
from pathlib import Path

import sqlalchemy as sa
from dbos import DBOS
from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings, from_environment
from app.db import connect, sessions, unit_of_work
from app.queue import APPLICATION, DIAGNOSES, POLLING_S, TESTS, VERSION
from app.runs.repository import RunRepository
from app.runs.service import MOST_ATTEMPTS, WORKER_SILENCE
from app.worker.diagnoser import Diagnoser
from app.worker.executor import Executor
from app.worker.link import Link

log = logging.getLogger("rths.worker")
WATCH_S = 0.1
BEAT_S = 1.0
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # engines share the cores among themselves


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="rths worker", description="Execute queued tests.")
    parser.add_argument("--data", type=Path, help="data folder (RTHS_DATA)")
    parser.add_argument("--database-url", help="database (RTHS_DATABASE_URL)")
    parser.add_argument("--web", default="ws://127.0.0.1:8000", help="address of the web service")
    parser.add_argument("--name", default=f"{socket.gethostname()}-{os.getpid()}", help="name of this worker")
    parser.add_argument("--workers", type=int, dest="worker_concurrency", help="tests at a time (RTHS_WORKERS)")
    parser.add_argument("--with-parent", action="store_true", help="end when standard input closes")
    given = parser.parse_args(arguments)
    settings = from_environment(
        data=given.data, database_url=given.database_url, worker_concurrency=given.worker_concurrency
    ).prepared()
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s worker %(levelname)s %(message)s")
    if given.with_parent:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the parent too, which ends this process in its order
        threading.Thread(target=_end_with_parent, daemon=True).start()
    work(settings, given.web, given.name)


def work(settings: Settings, web: str, name: str) -> None:
    """Serve the queue until the process ends."""
    os.environ.update(ONE_THREAD)  # read where engine processes load numpy
    engine = connect(settings.url)
    maker = sessions(engine)
    link = Link(f"{web}/api/v1/worker", settings.worker_token)
    executor = Executor(settings, maker, link, name)
    _register(executor, Diagnoser(settings, maker, name))
    DBOS(
        config={
            "name": APPLICATION,
            "system_database_engine": engine,
            "executor_id": name,
            "application_version": VERSION,
            "log_level": "WARNING",
            "run_migrations": False,
        }
    )
    DBOS.launch()
    for work, at_a_time in ((TESTS, settings.worker_concurrency), (DIAGNOSES, 1)):
        DBOS.register_queue(
            work.queue, worker_concurrency=at_a_time, polling_interval_sec=POLLING_S, on_conflict="always_update"
        )
    _watch(executor, maker, name)


def _register(executor: Executor, diagnoser: Diagnoser) -> None:
    attempts = MOST_ATTEMPTS + 1  # the last one parks the job

    @DBOS.step(name="execute", retries_allowed=True, max_attempts=attempts)
    def execute(run_id: str) -> None:
        executor.execute(run_id)

    @DBOS.workflow(name=TESTS.workflow, max_recovery_attempts=None)
    def run_test(run_id: str) -> None:
        execute(run_id)

    @DBOS.step(name="diagnose", retries_allowed=True, max_attempts=attempts)
    def diagnose(diagnosis_id: str) -> None:
        diagnoser.execute(diagnosis_id)

    @DBOS.workflow(name=DIAGNOSES.workflow, max_recovery_attempts=None)
    def run_diagnosis(diagnosis_id: str) -> None:
        diagnose(diagnosis_id)


def _watch(executor: Executor, maker: sessionmaker[Session], name: str) -> None:
    """Pass on cancels, say that this worker is alive, and take over the jobs of workers that are not."""
    beaten = 0.0
    while True:
        try:
            executor.cancel_requested()
            if time.monotonic() - beaten >= BEAT_S:
                beaten = time.monotonic()
                _beat(maker, name)
        except sa.exc.OperationalError as error:
            log.warning("the database did not answer: %s", error)
        time.sleep(WATCH_S)


def _beat(maker: sessionmaker[Session], name: str) -> None:
    with unit_of_work(maker) as session:
        runs = RunRepository(session)
        runs.beat(name)
        silent = runs.silent_workers(datetime.now(UTC) - WORKER_SILENCE)
    for dead in silent:
        for workflow in DBOS.list_workflows(status="PENDING", executor_id=dead):
            DBOS.resume_workflow(workflow.workflow_id, queue_name=workflow.queue_name)
        with unit_of_work(maker) as session:
            RunRepository(session).forget_worker(dead)


def _end_with_parent() -> None:
    sys.stdin.buffer.read()
    os._exit(0)
