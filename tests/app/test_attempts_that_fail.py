"""What the process of a job says of an attempt that failed."""

from __future__ import annotations

import errno
from types import SimpleNamespace
from typing import Any, cast

import pytest

from app.jobs.order import Order
from app.worker.child import Failed, Line, Refused, attempted

FULL = "The disk is full. Delete what is no longer needed, or enlarge the disk, then retry."
OF_H5PY = "Can't decrement id ref count (file write failed: errno = 28, error message = 'No space left on device')"


@pytest.mark.parametrize("stopped", [False, True])
@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), FULL),
        (OSError("[Errno 28] Can't write data (error message = 'No space left on device')"), FULL),
        (RuntimeError(OF_H5PY), FULL),
        (PermissionError(errno.EACCES, "Permission denied"), "A file could not be read or written: Permission denied."),
        (
            OSError("Unable to open file (file signature not found)"),
            "A file could not be read or written: Unable to open file ",
        ),
        (ValueError("the step is zero"), "ValueError: the step is zero"),
    ],
)
def test_the_reason_is_a_sentence_and_a_test_that_was_cancelled_before_stays_cancelled(
    error: Exception, reason: str, stopped: bool
) -> None:
    failed = fails(error, stopped)
    assert failed.reason.startswith(reason) and failed.stopped is stopped


def test_a_refusal_is_told_as_it_is() -> None:
    assert fails(Refused("The rig is in use."), True) == Failed("The rig is in use.")


def fails(error: Exception, stopped: bool) -> Failed:
    """The outcome of an attempt that raises `error`, after a cancel or without one."""

    def execute(*_: Any) -> None:
        raise error

    line = cast(Line, SimpleNamespace(stopped=stopped))
    outcome = attempted(SimpleNamespace(execute=execute), Order("run", 1), line)
    assert isinstance(outcome, Failed)
    return outcome
