"""Patience with a database that does not answer for a while: what is done, is done once it answers again."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import TypeVar

from app.db import DATABASE_SILENT

log = logging.getLogger("rths.worker")
PAUSES_S = (0.1, 0.2, 0.5, 1.0, 2.0)  # the last again and again
Answer = TypeVar("Answer")


def patiently(action: Callable[[], Answer]) -> Answer:
    """Do `action`, which is one transaction, again and again until the database answers: an outage ends no test."""
    tried = 0
    while True:
        try:
            return action()
        except DATABASE_SILENT as error:
            pause = PAUSES_S[min(tried, len(PAUSES_S) - 1)]
            log.warning("the database did not answer, next try in %g s: %s", pause, error.__cause__ or error)
            time.sleep(pause)
            tried += 1
