"""Room on the disk for the recording of a test, held from before its start until it is saved."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from app.worker.child import Refused

HEADER = 200_000  # bytes of plan, summary and declarations


@contextmanager
def room_for(run: Any, recording: Path) -> Iterator[Callable[[], None]]:
    """Hold the room until the function that this gives is called, just before the save. Raises Refused where there is none."""
    from app.disk import held
    from app.full import DiskFull

    try:
        with held(recording, largest(run)) as release:
            yield release
    except DiskFull as full:
        raise Refused(str(full)) from None


def largest(run: Any) -> int:
    """Size (bytes) that the recording of a run does not exceed: its numbers as they are, with the timing of each step."""
    return int(run.signals.nbytes + run.history.nbytes + 8 * len(run.signals) + HEADER)
