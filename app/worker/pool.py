"""Processes that execute jobs of one kind, one process for each job that may run at the same time."""

from __future__ import annotations

import contextlib
import multiprocessing
import queue
import select
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.jobs.kind import Kind
from app.jobs.order import Order
from app.worker.child import Assured, Cancel, Done, Failed, Ready, Stopping, serve

CANCEL_PATIENCE_S = 2.0
Listener = Callable[[Any], None]


class ProcessDied(Exception):
    """The process ended during a job; another process can execute the job."""


@dataclass(frozen=True, slots=True)
class Killed:
    """The process was killed because its job was cancelled; nothing of the job is stored."""


Outcome = Done | Failed | Killed


class JobProcess:
    """One process and the pipe to it."""

    def __init__(self, kind: Kind[Any, Any, Any]) -> None:
        self._kind = kind
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        arguments = (theirs, kind.process, kind.niceness)
        self._process = context.Process(target=serve, args=arguments, daemon=True, name=f"rths-{kind.name}")
        self._process.start()
        theirs.close()
        self._sending = threading.Lock()
        self.order: Order | None = None
        self._asked: Order | None = None
        self._stopping: Order | None = None
        self._ready = False
        self._killed: Failed | Killed | None = None

    def execute(self, order: Order, listener: Listener) -> Outcome:
        """Execute a job; messages of the process go to `listener`. Raises ProcessDied."""
        try:
            return self._follow(order, listener)
        except (EOFError, OSError):
            self._process.join(CANCEL_PATIENCE_S)
            if self._killed:
                return self._killed
            raise ProcessDied(f"exit code {self._process.exitcode}") from None
        except BaseException:
            self.stop()  # the process still executes this job and must not get another
            raise
        finally:
            self.order = None

    def wait_ready(self) -> None:
        """Wait until the process is ready, or has died."""
        with contextlib.suppress(EOFError, OSError):
            while not self._ready:
                self._ready = isinstance(self._pipe.recv(), Ready)

    def cancel(self, order: Order) -> None:
        """Stop the job of an order, once; nothing happens where the process executes another one by now.

        A kind with `keeps_when_cancelled` stores its samples: the process is asked to stop, and killed if it does not answer
        within CANCEL_PATIENCE_S. The process of any other kind is killed at once.
        """
        with self._sending:
            if self.order is not order or order is self._asked:
                return
            self._asked = order
            if not self._kind.keeps_when_cancelled:
                self._kill(Killed())
                return
            try:
                self._pipe.send(Cancel(order.job_id))
            except OSError:
                return
        timer = threading.Timer(CANCEL_PATIENCE_S, self._kill_unless_stopping, args=(order,))
        timer.daemon = True
        timer.start()

    def assure(self, order: Order, left_s: float) -> None:
        """Say that this worker is known to live for another `left_s`. Never waits for a process that reads nothing."""
        with self._sending:
            if self.order is not order or not select.select([], [self._pipe], [], 0)[1]:
                return
            with contextlib.suppress(OSError):
                self._pipe.send(Assured(left_s))

    @property
    def alive(self) -> bool:
        return self._process.is_alive()

    def stop(self) -> None:
        """Kill the process, also during a job."""
        self._process.kill()
        self._process.join(CANCEL_PATIENCE_S)
        self._pipe.close()

    def _follow(self, order: Order, listener: Listener) -> Done | Failed:
        with self._sending:
            self.order = order
            self._pipe.send(order)
        while True:
            heard = self._pipe.recv()
            if isinstance(heard, Done | Failed):
                return heard
            if isinstance(heard, Stopping):
                self._stopping = order
            else:
                listener(heard)

    def _kill_unless_stopping(self, order: Order) -> None:
        if self.order is order and self._stopping is not order:
            late = f"The {self._kind.noun} did not stop within {CANCEL_PATIENCE_S:g} s of the cancel request"
            self._kill(Failed(f"{late}, so its process was killed. Nothing was stored."))

    def _kill(self, outcome: Failed | Killed) -> None:
        self._killed = outcome
        self._process.kill()


class Pool:
    """The processes of one kind of job. Without `kept_warm`, a process starts when taken and ends when given back.

    With it, processes start here, or without `started_early` when first taken, and are kept.
    """

    def __init__(self, kind: Kind[Any, Any, Any], size: int):
        self.kind = kind
        self._idle: queue.LifoQueue[JobProcess | None] = queue.LifoQueue()
        for _ in range(size):
            self._idle.put(JobProcess(kind) if kind.kept_warm and kind.started_early else None)

    def take(self) -> JobProcess:
        """A process that is ready; waits until one is free."""
        process = self._idle.get()
        if process is None or not process.alive:
            process = JobProcess(self.kind)
        process.wait_ready()
        return process

    def give(self, process: JobProcess) -> None:
        if self.kind.kept_warm:
            self._idle.put(process)
        else:
            process.stop()
            self._idle.put(None)
