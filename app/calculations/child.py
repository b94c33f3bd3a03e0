"""The process of one calculation: take the order, keep its bounds, answer, and end."""

from __future__ import annotations

import contextlib
import math
import os
import pickle
import resource
import socket
import time

from app.calculations.wire import HEAD, Said, message

MEGABYTE = 1_000_000
PAGE = resource.getpagesize()
SPARE = 50 * MEGABYTE  # for the answer of a calculation that met its bound


def execute(line: socket.socket) -> None:
    """Execute the one order that comes over a line, and answer."""
    _, size = HEAD.unpack(_received(line, HEAD.size))
    function, arguments, named, seconds, megabytes = pickle.loads(_received(line, size))
    try:
        _bound(seconds, megabytes)
        reply = message(Said.ANSWER, pickle.dumps(function(*arguments, **named), pickle.HIGHEST_PROTOCOL))
    except BaseException as error:
        _lift()
        reply = message(Said.RAISED, _pickled(error))
    with contextlib.suppress(OSError):  # the service has left
        line.sendall(reply)


def _bound(seconds: int, megabytes: int) -> None:
    """Limit this process; the signal of its processor time ends it."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    used = math.ceil(time.process_time())  # modules that were not loaded yet
    resource.setrlimit(resource.RLIMIT_CPU, (used + seconds, used + seconds + 2))
    with contextlib.suppress(OSError), open("/proc/self/statm", encoding="ascii") as statm:  # Linux
        present = int(statm.read().split()[0]) * PAGE
        resource.setrlimit(resource.RLIMIT_AS, (present + megabytes * MEGABYTE, present + megabytes * MEGABYTE + SPARE))


def _lift() -> None:
    """Make room for the answer."""
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))


def _pickled(error: BaseException) -> bytes:
    """An error that can be raised in another process: itself, or its name and sentence."""
    try:
        body = pickle.dumps(error)
        pickle.loads(body)
        return body
    except Exception:
        return pickle.dumps(RuntimeError(f"{type(error).__name__}: {error}"))


def _received(line: socket.socket, size: int) -> bytes:
    parts = []
    while size:
        part = line.recv(min(size, 1 << 20))
        if not part:
            os._exit(0)  # the service has left
        parts.append(part)
        size -= len(part)
    return b"".join(parts)
