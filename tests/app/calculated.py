"""Calculations for tests: what the processes of app.calculations execute."""

from __future__ import annotations

import os
import time
from pathlib import Path

from rths_engine.foundation.errors import Issue, RthsError


def process() -> int:
    """The number of the process."""
    return os.getpid()


def refused() -> None:
    """An input that is refused."""
    raise RthsError(Issue("plan.name", "is blank", "", "give a name"))


def works_on() -> None:
    """Use the processor until the end of time."""
    while True:
        pass


def takes(megabytes: int) -> int:
    """Use memory."""
    return len(bytearray(megabytes * 1_000_000))


def dies() -> None:
    """End without an answer."""
    os._exit(3)


def waits(started: Path, folder: Path) -> str:
    """Say that it has started, and end when the file `go` is in a folder."""
    started.write_text(str(os.getpid()))
    while not (folder / "go").exists():
        time.sleep(0.01)
    return started.name
