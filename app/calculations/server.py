"""The server of processes: it loads the modules of the calculations once, and forks a process for each calculation.

`python -m app.calculations.server FD MODULE ...` reads from the Unix socket FD. A module may be followed by `:` and a function
that loads more. Each message has two descriptors: the line of a calculation, and a pipe that closes when nobody waits for it
any more; then its process is killed. A fork takes some milliseconds, so that a process serves one calculation only: its bounds
are those of the operating system, and nothing is left over.
"""

from __future__ import annotations

import os

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")  # before numpy: threads do not survive a fork

import contextlib
import gc
import importlib
import logging
import selectors
import signal
import socket
import struct
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from app.calculations import child
from app.calculations.wire import Said, message
from app.imports import uncollected

log = logging.getLogger("rths.calculations")
NICENESS = 5  # tests and pages come first


@dataclass(slots=True)
class Calculation:
    """A process, its line to the service, and the pipe that the service keeps open while it waits."""

    pid: int
    line: socket.socket
    life: int


class Server:
    """Forks, kills and reaps the processes of calculations. One thread."""

    def __init__(self, control: socket.socket, modules: Sequence[str]):
        self.control, self.modules = control, list(modules)
        self.running: dict[int, Calculation] = {}
        self.events = selectors.DefaultSelector()
        self.events.register(control, selectors.EVENT_READ, self._order)
        self.wake, theirs = os.pipe()
        os.set_blocking(self.wake, False)
        os.set_blocking(theirs, False)
        signal.set_wakeup_fd(theirs)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        self.events.register(self.wake, selectors.EVENT_READ, self._reap)

    def serve(self) -> None:
        """Serve until the service has ended. Modules are loaded while nothing else is to do."""
        while True:
            ready = self.events.select(0 if self.modules else None)
            for key, _ in ready:
                key.data()
            if not ready and self.modules:
                _load(self.modules.pop(0))

    def _order(self) -> None:
        said, given, _, _ = socket.recv_fds(self.control, 1, 2)
        if not said:
            for one in self.running.values():
                os.kill(one.pid, signal.SIGKILL)
            os._exit(0)
        line, life = socket.socket(fileno=given[0]), given[1]
        gc.collect()
        gc.freeze()  # so that the processes share the memory of the modules
        pid = os.fork()
        if not pid:
            self._become(line)
        one = self.running[life] = Calculation(pid, line, life)
        self.events.register(life, selectors.EVENT_READ, lambda: self._kill(one))

    def _kill(self, one: Calculation) -> None:
        """Nobody waits for this calculation any more."""
        if self.running.get(one.life) is one:  # else it has just ended
            self.events.unregister(one.life)
            os.kill(one.pid, signal.SIGKILL)

    def _reap(self) -> None:
        with contextlib.suppress(BlockingIOError):
            while os.read(self.wake, 512):
                pass
        for one in list(self.running.values()):
            pid, status = os.waitpid(one.pid, os.WNOHANG)
            if pid:
                self._over(one, status)

    def _over(self, one: Calculation, status: int) -> None:
        del self.running[one.life]
        with contextlib.suppress(KeyError):  # it was killed
            self.events.unregister(one.life)
        os.close(one.life)
        with one.line, contextlib.suppress(OSError):  # the service has left
            one.line.setblocking(False)
            one.line.sendall(message(Said.ENDED, struct.pack("<i", status)))

    def _become(self, line: socket.socket) -> None:
        """Be the process of a calculation, to its end."""
        try:
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            self.control.close()
            for other in self.running.values():
                other.line.close()
            child.execute(line)
        finally:
            os._exit(0)


def _load(named: str) -> None:
    module, _, function = named.partition(":")
    try:
        with uncollected():
            loaded = importlib.import_module(module)
            if function:
                getattr(loaded, function)()
    except Exception:
        log.exception("%s was not loaded for calculations", named)


def main() -> None:
    """Serve the socket whose number is the first argument."""
    os.nice(NICENESS)
    Server(socket.socket(fileno=int(sys.argv[1])), sys.argv[2:]).serve()


if __name__ == "__main__":
    main()
