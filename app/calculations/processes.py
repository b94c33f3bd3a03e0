"""The service's side of the server of processes: start it, ask it for a process, and talk with that process."""

from __future__ import annotations

import asyncio
import atexit
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache

from app.calculations.wire import HEAD, Said, message
from app.problems import Unavailable

SERVER = "app.calculations.server"
PREPARED = (
    "app.plans.service",
    "app.stability.service",
    "app.calculations.answer",
    "app.preflight.calculation:load",
    "app.measured.endpoints",
    "app.measured.batch_endpoints",
    "app.motions.endpoints",
    "app.compare.endpoints",
    "app.library.endpoints",
    "app.sweeps.analysis_endpoints",
    "app.publishing.endpoints",
    "app.publishing.run_endpoints",
)
"""What the server loads before the first calculation needs it, in this order: modules, and functions that load more."""
DIED = "The process of the calculations ended unexpectedly. Try again in a moment."


class Died(Exception):
    """A process ended without an answer; `signal` ended it."""

    def __init__(self, status: int):
        super().__init__(status)
        self.signal = os.WTERMSIG(status) if os.WIFSIGNALED(status) else None

    @property
    def out_of_time(self) -> bool:
        return self.signal == signal.SIGXCPU

    @property
    def out_of_memory(self) -> bool:
        """Whether compiled code ended it for want of memory."""
        return self.signal == signal.SIGABRT


class Processes:
    """The server of processes: a child of this process, which ends with it. It starts with the first calculation, or early."""

    def __init__(self, modules: Sequence[str] = PREPARED):
        self.modules = tuple(modules)
        self._lock = threading.Lock()
        self._server: subprocess.Popen[bytes] | None = None
        self._control: socket.socket | None = None

    def start(self) -> None:
        """Start the server, so that the first calculation finds its modules loaded."""
        with self._lock:
            self._ready()

    def close(self) -> None:
        """End the server and its processes."""
        with self._lock:
            self._end()

    async def ask(self, order: bytes) -> tuple[Said, bytes]:
        """Execute an order in a new process. Cancelling ends the process. Raises Died and Unavailable."""
        loop = asyncio.get_running_loop()
        with self._process() as line:
            try:
                await loop.sock_sendall(line, message(Said.ORDER, order))
                kind, size = HEAD.unpack(await _received(line, HEAD.size))
                body = await _received(line, size)
            except OSError:
                raise Unavailable(DIED) from None
        if kind == Said.ENDED:
            raise Died(struct.unpack("<i", body)[0])
        return Said(kind), body

    @contextmanager
    def _process(self) -> Iterator[socket.socket]:
        """The line to a new process, which is killed when this ends."""
        line, theirs = socket.socketpair()
        life, mine = os.pipe()
        try:
            with line:
                try:
                    with theirs, self._lock:
                        self._send(theirs, life)
                finally:
                    os.close(life)
                line.setblocking(False)
                yield line
        finally:
            os.close(mine)

    def _send(self, theirs: socket.socket, life: int) -> None:
        for _ in range(2):
            with suppress(OSError):  # the server has died: a new one is asked once
                socket.send_fds(self._ready(), [b"."], [theirs.fileno(), life])
                return
            self._end()
        raise Unavailable(DIED)

    def _ready(self) -> socket.socket:
        if self._control is not None and self._server is not None and self._server.poll() is None:
            return self._control
        self._end()
        self._control, theirs = socket.socketpair()
        command = [sys.executable, "-m", SERVER, str(theirs.fileno()), *self.modules]
        with theirs:
            # a group of its own: Ctrl-C reaches the service only, which ends this process
            self._server = subprocess.Popen(command, pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL, process_group=0)
        return self._control

    def _end(self) -> None:
        if self._control is not None:
            self._control.close()
        if self._server is not None:
            self._server.kill()
            self._server.wait()
        self._server = self._control = None


@cache
def shared() -> Processes:
    """The processes of this process: applications share them, and they end with it."""
    found = Processes()
    atexit.register(found.close)
    return found


async def _received(line: socket.socket, size: int) -> bytes:
    loop, parts = asyncio.get_running_loop(), []
    while size:
        part = await loop.sock_recv(line, min(size, 1 << 20))
        if not part:
            raise ConnectionResetError
        parts.append(part)
        size -= len(part)
    return b"".join(parts)
