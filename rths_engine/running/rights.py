"""What the operating system grants the thread of a paced loop: a core, real-time priority, memory that stays, sharp timers.

Each is a request. A refusal is a sentence in the result, never the end of a test.
"""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterator
from contextlib import contextmanager

from rths_engine.planning.plan import RealTime
from rths_engine.results.timing import Granted

# by definition in sys/prctl.h and sys/mman.h of Linux
PR_SET_TIMERSLACK, MCL_CURRENT = 29, 1


@contextmanager
def granted(pace: RealTime) -> Iterator[Granted]:
    """Ask for what a pace wants, for the calling thread; undone at the end. Yields what was granted."""
    refused: list[str] = []
    cores = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set()
    _sharp_timers()
    core = _pinned(pace.core, refused)
    priority = _prioritised(pace.priority, refused)
    locked = priority is not None and _call("mlockall", MCL_CURRENT)
    if priority is not None and not locked:
        refused.append("The memory of the test was not locked: the operating system refused. Raise its limit of locked memory.")
    try:
        yield Granted(pace.core, core, pace.priority, priority, locked, tuple(refused))
    finally:
        if locked:
            _call("munlockall")
        if priority is not None:
            os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
        if core is not None:
            os.sched_setaffinity(0, cores)
        _call("prctl", PR_SET_TIMERSLACK, 0, 0, 0, 0)  # 0: as before


def _sharp_timers() -> None:
    """Let the sleep of this thread end at its time: by default Linux may end it 50 us later to save energy."""
    _call("prctl", PR_SET_TIMERSLACK, 1, 0, 0, 0)


def _pinned(core: int | None, refused: list[str]) -> int | None:
    if core is None:
        return None
    if not hasattr(os, "sched_setaffinity"):
        refused.append(f"The loop was not pinned to core {core}: this operating system has no way to do it.")
        return None
    try:
        os.sched_setaffinity(0, {core})  # 0: the calling thread
    except OSError:
        known = ", ".join(str(one) for one in sorted(os.sched_getaffinity(0)))
        refused.append(f"The loop was not pinned to core {core}: this process may use the cores {known}.")
        return None
    return core


def _prioritised(priority: int | None, refused: list[str]) -> int | None:
    if priority is None:
        return None
    if not hasattr(os, "sched_setscheduler"):
        refused.append(f"Real-time priority {priority} was not granted: this operating system has no SCHED_FIFO.")
        return None
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError:
        refused.append(
            f"Real-time priority {priority} was not granted: the operating system refused. It needs CAP_SYS_NICE, or a line"
            " such as '@lab - rtprio 90' in /etc/security/limits.conf."
        )
        return None
    return priority


def _call(name: str, *arguments: int) -> bool:
    """Call a function of the C library; returns whether it exists and succeeded."""
    try:
        function = getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError, TypeError):
        return False
    return bool(function(*(ctypes.c_ulong(one) for one in arguments)) == 0)
