"""The process of a job: it executes orders, sends messages to its worker, and ends when the worker ends."""

from __future__ import annotations

import importlib
import math
import os
import queue
import signal
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from app import logs
from app.full import FIX, is_full
from app.imports import uncollected
from app.jobs.order import Order


@dataclass(frozen=True, slots=True)
class Cancel:
    """A request to stop a job; without effect if the job has already ended."""

    job_id: str


@dataclass(frozen=True, slots=True)
class Ready:
    """The process is ready for orders."""


@dataclass(frozen=True, slots=True)
class Stopping:
    """The answer to Cancel: the job has stopped, and the process is saving its result."""


@dataclass(frozen=True, slots=True)
class Assured:
    """The worker is known to live for another `left_s` seconds, so nobody takes its tests over meanwhile."""

    left_s: float


@dataclass(frozen=True, slots=True)
class CutOff:
    """The job has stopped itself: the worker was silent, or cut off from everybody else."""


@dataclass(frozen=True, slots=True)
class Progress:
    """Progress of a job: the present step in words, and the share that is done, 0 to 1."""

    doing: str
    share: float


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the result, for `Kind.store_part`: stored while the job runs, so that it is kept however the job ends."""

    result: Any


@dataclass(frozen=True, slots=True)
class Done:
    """The result of a job, for `Kind.store`."""

    result: Any


@dataclass(frozen=True, slots=True)
class Failed:
    """The reason why a job failed. `stopped`: it had stopped because it was cancelled, and failed afterwards."""

    reason: str
    stopped: bool = False


LOOK_S = 0.1  # between two looks of a process whether it still may move a machine
ASSURED_S = 4.5
"""How long a job that moves a machine goes on without a word from its worker, and a worker without a word from anybody.

It is less than the six seconds after which other workers take a silent one for dead: docs/decisions/0080.
"""


class Refused(Exception):
    """A job that cannot be executed; the message is the reason that people read."""


class Line:
    """The process' end of the pipe to its worker. A thread reads it, so that a cancel or the end of the worker acts at once."""

    def __init__(self, pipe: Connection):
        self._pipe = pipe
        self._orders: queue.SimpleQueue[Order] = queue.SimpleQueue()
        self._current: str | None = None
        self._cancelled = threading.Event()
        self.stopped = False
        self.stop_machine: Callable[[], None] = lambda: None
        """What stops the machines of the present job at once; called by another thread."""
        self._until = math.inf
        threading.Thread(target=self._listen, daemon=True, name="rths-line").start()

    def order(self) -> Order:
        """Wait for the next order and return it."""
        return self._orders.get()

    def send(self, message: Any) -> None:
        self._pipe.send(message)

    def show(self, message: Any) -> None:
        """Send a frame or a message to the viewers of the job."""
        self.send(message)

    def progress(self, doing: str, share: float) -> None:
        """Send the progress of the job: the present step in words, and the share that is done, 0 to 1."""
        self.send(Progress(doing, min(1.0, max(0.0, float(share)))))

    def part(self, result: Any) -> None:
        """Send a part of the result; the worker stores it at once."""
        self.send(Part(result))

    def cancelled(self, within_s: float = 0.0) -> bool:
        """Whether the job was cancelled; waits up to `within_s` seconds for a cancel."""
        return self._cancelled.wait(within_s)

    def stopping(self) -> None:
        """Answer a cancel: the job has stopped, and the process is saving its result."""
        self.stopped = True
        self.send(Stopping())

    def _listen(self) -> None:
        while True:
            try:
                if not self._pipe.poll(LOOK_S):
                    self._look()
                    continue
                heard = self._pipe.recv()
            except (EOFError, OSError):
                os._exit(0)  # the worker has ended
            self._look()
            if isinstance(heard, Assured):
                self._until = max(self._until, time.monotonic() + heard.left_s)
            elif isinstance(heard, Order):
                self._cancelled.clear()
                self.stopped = False
                self.stop_machine = lambda: None
                self._until = time.monotonic() + ASSURED_S if heard.moves else math.inf
                self._current = heard.job_id
                self._orders.put(heard)
            elif heard == Cancel(self._current or ""):
                self._cancelled.set()

    def _look(self) -> None:
        """Stop the present job where nobody says any more that the worker lives."""
        if time.monotonic() > self._until:
            self._until = math.inf
            self.stop_machine()
            self._cancelled.set()
            self.send(CutOff())


def serve(pipe: Connection, module: str, niceness: int) -> None:
    """Execute orders with `module` (`Kind.process`) until the worker ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C also reaches the worker, which ends this process
    logs.inherit()
    line = Line(pipe)
    os.nice(niceness)
    with uncollected():
        executing = importlib.import_module(module)
        executing.prepare()
    try:
        line.send(Ready())
        while True:
            line.send(attempted(executing, line.order(), line))
    except ConnectionError:
        return  # the worker has ended


def attempted(executing: Any, order: Order, line: Line) -> Done | Failed:
    """The outcome of an attempt. Raises ConnectionError when the worker has ended."""
    try:
        with logs.about(run=order.job_id):
            return Done(executing.execute(order, line))
    except ConnectionError:
        raise
    except Refused as refused:
        return Failed(str(refused))
    except Exception as error:
        return Failed(_reason(error), line.stopped)


def _reason(error: Exception) -> str:
    """Why an attempt failed. Of the packages that write files, h5py says with other errors too that the disk is full."""
    if is_full(error):
        return f"The disk is full. {FIX}, then retry."
    if isinstance(error, OSError):
        return f"A file could not be read or written: {os.strerror(error.errno) if error.errno else error}."
    return f"{type(error).__name__}: {error}"
