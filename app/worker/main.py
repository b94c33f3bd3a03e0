"""The worker: executes jobs of every kind from their queues.

`python -m app.worker` starts a worker on any machine that reaches the database and the data folder.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import socket
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from dbos import DBOS
from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings, from_environment
from app.db import connect, sessions, unit_of_work
from app.jobs.kind import Kind
from app.jobs.queue import APPLICATION, VERSION
from app.jobs.service import MOST_ATTEMPTS
from app.jobs.workers import Workers
from app.worker.executor import Executor
from app.worker.kinds import KINDS
from app.worker.link import Link

log = logging.getLogger("rths.worker")
WATCH_S = 0.1
BEAT_S = 1.0
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # the processes of jobs share the cores


def main(arguments: list[str] | None = None) -> None:
    """`python -m app.worker`: execute queued jobs until the process ends."""
    parser = argparse.ArgumentParser(prog="rths worker", description="Execute queued tests and diagnoses.")
    parser.add_argument("--data", type=Path, help="data folder (RTHS_DATA)")
    parser.add_argument("--database-url", help="database (RTHS_DATABASE_URL)")
    parser.add_argument("--web", default="ws://127.0.0.1:8000", help="address of the web service")
    parser.add_argument("--name", default=f"{socket.gethostname()}-{os.getpid()}", help="name of this worker")
    parser.add_argument("--workers", type=int, dest="worker_concurrency", help="tests at the same time (RTHS_WORKERS)")
    parser.add_argument("--with-parent", action="store_true", help="end when standard input closes")
    given = parser.parse_args(arguments)
    settings = from_environment(
        data=given.data, database_url=given.database_url, worker_concurrency=given.worker_concurrency
    ).prepared()
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s worker %(levelname)s %(message)s")
    if given.with_parent:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C also reaches the parent, which ends this process
        threading.Thread(target=_end_with_parent, daemon=True).start()
    work(settings, given.web, given.name)


def work(settings: Settings, web: str, name: str, kinds: Sequence[Kind[Any, Any, Any]] = KINDS) -> None:
    """Serve the queues of all kinds of job until the process ends."""
    os.environ.update(ONE_THREAD)  # read where the processes of jobs load numpy
    engine = connect(settings.url)
    maker = sessions(engine)
    link = Link(f"{web}/api/v1/worker", settings.worker_token)
    executor = Executor(settings, maker, link, name, kinds)
    for kind in kinds:
        _register(kind, executor)
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
    for kind in kinds:
        DBOS.register_queue(
            kind.queue,
            worker_concurrency=kind.at_a_time(settings) + kind.ahead,
            polling_interval_sec=kind.polling_s,
            on_conflict="always_update",
        )
    _watch(executor, maker, name, settings.worker_concurrency)


def _register(kind: Kind[Any, Any, Any], executor: Executor) -> None:
    attempts = MOST_ATTEMPTS + 1  # the last attempt ends the job as failed

    @DBOS.step(name=f"execute-{kind.name}", retries_allowed=True, max_attempts=attempts)
    def execute(turn: str) -> None:
        executor.execute(kind, turn)

    @DBOS.workflow(name=kind.workflow, max_recovery_attempts=None)
    def run(turn: str) -> None:
        execute(turn)


def _watch(executor: Executor, maker: sessionmaker[Session], name: str, tests_at_a_time: int) -> None:
    """Store progress, pass on cancels, write this worker's heartbeat, and take over the jobs of workers that have died."""
    beaten = 0.0
    while True:
        try:
            executor.look()
            if time.monotonic() - beaten >= BEAT_S:
                beaten = time.monotonic()
                _beat(maker, name, tests_at_a_time)
        except sa.exc.OperationalError as error:
            log.warning("the database did not answer: %s", error)
        time.sleep(WATCH_S)


def _beat(maker: sessionmaker[Session], name: str, tests_at_a_time: int) -> None:
    with unit_of_work(maker) as session:
        workers = Workers(session)
        workers.beat(name, tests_at_a_time)
        silent = workers.silent()
    for dead in silent:
        for workflow in DBOS.list_workflows(status="PENDING", executor_id=dead):
            DBOS.resume_workflow(workflow.workflow_id, queue_name=workflow.queue_name)
        with unit_of_work(maker) as session:
            Workers(session).forget(dead)


def _end_with_parent() -> None:
    sys.stdin.buffer.read()
    os._exit(0)
