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
from contextlib import suppress
from pathlib import Path
from typing import Any

from dbos import DBOS
from sqlalchemy.orm import Session, sessionmaker

from app import logs
from app.audit.log import Acting, acts
from app.config import Settings, from_environment
from app.db import DATABASE_SILENT, check_schema, connect, sessions
from app.jobs.kind import Kind
from app.jobs.queue import APPLICATION, VERSION, DurableQueue
from app.jobs.service import MOST_ATTEMPTS
from app.latch import Latch
from app.memory import share_arenas
from app.monitoring import reporting, statements
from app.private import OTHERS
from app.runs.job import UNSENT
from app.store.opening import store_of
from app.worker.contact import Contact
from app.worker.executor import Executor
from app.worker.kinds import KINDS
from app.worker.link import Links
from app.worker.lost import Lost
from app.worker.patience import patient_engine, patiently
from app.worker.peers import Peers, unique
from app.worker.stopping import Stopper
from app.worker.trust import context
from rths_engine.foundation.errors import RthsError

log = logging.getLogger("rths.worker")
WATCH_S = 0.1
LOOK_S = 1.0  # between two heartbeats, each with a look at the other workers
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # the processes of jobs share the cores


def main(arguments: list[str] | None = None) -> None:
    """`python -m app.worker`: execute queued jobs until the process ends."""
    parser = argparse.ArgumentParser(prog="rths worker", description="Execute queued tests and diagnoses.")
    parser.add_argument("--data", type=Path, help="data folder (RTHS_DATA)")
    parser.add_argument("--database-url", help="database (RTHS_DATABASE_URL)")
    parser.add_argument("--web", default="ws://127.0.0.1:8000", help="addresses of the web services, separated by commas")
    parser.add_argument("--name", default=socket.gethostname(), help="name of this worker")
    parser.add_argument("--boot", help="word that tells this start of the worker apart from others of the same name")
    parser.add_argument("--workers", type=int, dest="worker_concurrency", help="tests at the same time (RTHS_WORKERS)")
    parser.add_argument("--with-parent", action="store_true", help="end when standard input closes")
    given = parser.parse_args(arguments)
    os.umask(OTHERS)
    share_arenas()
    settings = from_environment(
        data=given.data, database_url=given.database_url, worker_concurrency=given.worker_concurrency
    ).prepared()
    logs.configure(settings.log_format, settings.log_level, worker=given.name)
    if given.with_parent:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C also reaches the parent, which ends this process
        threading.Thread(target=_end_with_parent, daemon=True).start()
    try:
        work(settings, given.web, unique(given.name, given.boot))
    except RthsError as error:
        sys.exit(f"rths worker: {error}")


def work(settings: Settings, web: str, worker: str, kinds: Sequence[Kind[Any, Any, Any]] = KINDS) -> None:
    """Serve the queues of all kinds of job until the process ends. `worker` is the identity of this process: unique().

    Raises RthsError where the schema of the database is not the one of this program.
    """
    check_schema(settings.url)
    for address in web.split(","):
        context(address)
    os.environ.update(ONE_THREAD)  # read where the processes of jobs load numpy
    engine = connect(settings.url)
    statements.watch(engine)
    maker = sessions(engine)
    acts(maker, Acting(worker, "worker"))
    latch = Latch()
    stopper = Stopper(latch)
    contact = Contact()
    links = Links(web, settings.worker_token, worker, stopper, contact)
    queue = DurableQueue(engine)
    executor = Executor(settings, maker, links, worker, kinds, latch, lambda delivery: queue.holder(delivery) == worker)
    stopper.start(executor.stop_tests)
    contact.serve(executor, settings.worker_concurrency)
    peers = Peers(maker, worker, settings.worker_concurrency, contact)
    patiently(peers.beat)  # before the queue is served: whoever holds a turn without a heartbeat is dead
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    for kind in kinds:
        _register(kind, executor)
    DBOS(
        config={
            "name": APPLICATION,
            "system_database_engine": patient_engine(settings.url),
            "executor_id": worker,
            "application_version": VERSION,
            "log_level": settings.log_level.upper(),
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
    reporting.start(maker, worker)
    if (settings.data / UNSENT).is_dir():
        threading.Thread(target=send_kept, args=(settings, maker), daemon=True, name="rths-unsent").start()
    try:
        _watch(executor, peers, stopper, Lost(executor, queue, kinds))
    finally:
        with suppress(Exception):
            peers.leave()
        os._exit(0)


def _register(kind: Kind[Any, Any, Any], executor: Executor) -> None:
    attempts = MOST_ATTEMPTS + 1  # the last attempt ends the job as failed

    @DBOS.step(name=f"execute-{kind.name}", retries_allowed=True, max_attempts=attempts)
    def execute(turn: str) -> None:
        executor.execute(kind, turn, DBOS.workflow_id or turn)

    @DBOS.workflow(name=kind.workflow, max_recovery_attempts=None)
    def run(turn: str) -> None:
        execute(turn)


def send_kept(settings: Settings, maker: sessionmaker[Session]) -> None:
    """Send the recordings that the store did not take before this worker was started; what fails again stays."""
    from app.runs.unsent import send  # loads numpy and HDF5

    try:
        for one in send(settings.data / UNSENT, maker, store_of(settings)):
            log.warning("the recording %s that was not sent before: %s", one.path, one.sentence)
    except (OSError, *DATABASE_SILENT) as error:
        log.warning("recordings stay in %s: %s", settings.data / UNSENT, error)


def _watch(executor: Executor, peers: Peers, stopper: Stopper, lost: Lost) -> None:
    """Store progress, pass on cancels, write this worker's heartbeat, take over from the dead, and find what the queue lost."""
    looked = 0.0
    while True:
        try:
            stopper.look(executor.maker, [pool.kind for pool in executor.pools.values()])
            executor.look()
            if time.monotonic() - looked >= LOOK_S:
                looked = time.monotonic()
                lost.look(peers.look())
        except DATABASE_SILENT as error:
            log.warning("the database did not answer: %s", error.__cause__ or error)
        time.sleep(WATCH_S)


def _end_with_parent() -> None:
    sys.stdin.buffer.read()
    os._exit(0)
