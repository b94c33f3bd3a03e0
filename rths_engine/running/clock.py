"""The monotonic clock of the machine for compiled code: read it, and sleep until a time of it.

Linux has both as functions of its C library, which compiled code calls without the interpreter. Elsewhere the interpreter's own
clock and sleep take their place; they wait for the interpreter lock, so their times are less sharp.
"""

from __future__ import annotations

import time
from typing import Any

from llvmlite import binding
from numba import objmode, types

from rths_engine.foundation.kernel import compiled

SECOND = 1_000_000_000  # ns, by definition
# CLOCK_MONOTONIC and TIMER_ABSTIME of time.h in Linux
MONOTONIC, ABSOLUTE = 1, 1
OF_THE_SYSTEM = all(binding.address_of_symbol(name) for name in ("clock_gettime", "clock_nanosleep"))

_gettime: Any = types.ExternalFunction("clock_gettime", types.intc(types.intc, types.uintp))
_nanosleep: Any = types.ExternalFunction("clock_nanosleep", types.intc(types.intc, types.intc, types.uintp, types.uintp))


def system_now(spec):
    """The time (ns). `spec` (2) is memory for a timespec."""
    _gettime(MONOTONIC, spec.ctypes.data)
    return spec[0] * SECOND + spec[1]


def system_sleep(until, spec):
    """Sleep until a time (ns); a time that has passed returns at once."""
    spec[0], spec[1] = until // SECOND, until % SECOND
    _nanosleep(MONOTONIC, ABSOLUTE, spec.ctypes.data, 0)


def portable_now(spec):
    """The time (ns) by the interpreter."""
    with objmode(read="int64"):
        read = time.monotonic_ns()
    return read


def portable_sleep(until, spec):
    """Sleep until a time (ns) by the interpreter."""
    with objmode():
        time.sleep(max(0.0, (until - time.monotonic_ns()) / 1e9))


now = compiled(system_now if OF_THE_SYSTEM else portable_now)
sleep = compiled(system_sleep if OF_THE_SYSTEM else portable_sleep)
