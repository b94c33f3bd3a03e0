"""`rths worker`, `rths migrate`."""

from __future__ import annotations

import os
import socket
from argparse import Namespace

from app import db, logs
from app.cli.settings import stored
from app.jobs import queue
from app.leases import alone
from app.moving.places import using
from app.worker.main import work
from app.worker.peers import unique


def worker(given: Namespace) -> None:
    """`rths worker`: execute queued jobs until the process ends."""
    if given.ca:
        os.environ["RTHS_CA"] = str(given.ca)
    settings = stored(given)
    name = unique(given.name or socket.gethostname())
    logs.configure(settings.log_format, settings.log_level, worker=name)
    with using(settings):
        work(settings, given.web, name)


def migrate(given: Namespace) -> None:
    """`rths migrate`: bring the database and its queue to the newest schema."""
    settings = stored(given)
    with alone(settings.url):
        db.migrate(settings.url)
        queue.migrate(settings.url)
