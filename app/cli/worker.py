"""`rths worker`."""

from __future__ import annotations

import os
import socket
from argparse import Namespace

from app import logs
from app.cli.settings import stored
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
