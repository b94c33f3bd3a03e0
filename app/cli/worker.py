"""`rths worker`, `rths migrate`."""

from __future__ import annotations

import socket
from argparse import Namespace

from app import db, logs
from app.cli.settings import stored
from app.jobs import queue
from app.worker.main import work
from app.worker.peers import unique


def worker(given: Namespace) -> None:
    """`rths worker`: execute queued jobs until the process ends."""
    settings = stored(given)
    name = unique(given.name or socket.gethostname())
    logs.configure(settings.log_format, settings.log_level, worker=name)
    work(settings, given.web, name)


def migrate(given: Namespace) -> None:
    """`rths migrate`: bring the database and its queue to the newest schema."""
    settings = stored(given)
    db.migrate(settings.url)
    queue.migrate(settings.url)
