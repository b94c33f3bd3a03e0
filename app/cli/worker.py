"""`rths worker`, `rths migrate`."""

from __future__ import annotations

import logging
import socket
from argparse import Namespace

from app import db
from app.cli.settings import stored
from app.jobs import queue
from app.worker.main import work
from app.worker.peers import unique


def worker(given: Namespace) -> None:
    """`rths worker`: execute queued jobs until the process ends."""
    settings = stored(given)
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s worker %(levelname)s %(message)s")
    work(settings, given.web, unique(given.name or socket.gethostname()))


def migrate(given: Namespace) -> None:
    """`rths migrate`: bring the database and its queue to the newest schema."""
    settings = stored(given)
    db.migrate(settings.url)
    queue.migrate(settings.url)
