"""Warm engine processes, one for each test that may run at a time."""

from __future__ import annotations

import contextlib
import multiprocessing
import queue
import threading
from collections.abc import Callable
from typing import Any

from app.worker.engine import Cancel, Done, Failed, Job, Ready, Stopping, serve

CANCEL_PATIENCE_S = 2.0
KILLED = (
    f"The engine did not answer within {CANCEL_PATIENCE_S:g} s of being asked to stop, and was ended; nothing was recorded."
)
Listener = Callable[[Any], None]


class EngineDied(Exception):
    """The engine process ended in the middle of a job; the job can be given to another."""


class EngineProcess:
    """One engine process and the pipe to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=serve, args=(theirs,), daemon=True, name="rths-engine")
        self._process.start()
        theirs.close()
        self._sending = threading.Lock()
        self.job: Job | None = None
        self._asked: Job | None = None
        self._stopping: Job | None = None
        self._ready = self._killed = False

    def execute(self, job: Job, listener: Listener) -> Done | Failed:
        """Run a job; what the engine tells meanwhile goes to `listener`. Raises EngineDied."""
        try:
            return self._follow(job, listener)
        except (EOFError, OSError):
            self._process.join(CANCEL_PATIENCE_S)
            if self._killed:
                return Failed(KILLED)
            raise EngineDied(f"exit code {self._process.exitcode}") from None
        except BaseException:
            self._process.kill()  # it is in the middle of this job and must not be given another
            self._process.join()
            raise
        finally:
            self.job = None

    def wait_ready(self) -> None:
        """Wait until the engine is compiled, or has died of it."""
        with contextlib.suppress(EOFError, OSError):
            while not self._ready:
                self._ready = isinstance(self._pipe.recv(), Ready)

    def cancel(self) -> None:
        """Ask the engine, once, to stop and keep what it recorded; kill it where it does not answer."""
        with self._sending:
            job = self.job
            if job is None or job is self._asked:
                return
            self._asked = job
            try:
                self._pipe.send(Cancel(job.run_id))
            except OSError:
                return
        timer = threading.Timer(CANCEL_PATIENCE_S, self._kill_unless_stopping, args=(job,))
        timer.daemon = True
        timer.start()

    @property
    def alive(self) -> bool:
        return self._process.is_alive()

    def stop(self) -> None:
        self._pipe.close()
        self._process.kill()

    def _follow(self, job: Job, listener: Listener) -> Done | Failed:
        with self._sending:
            self.job = job
            self._pipe.send(job)
        while True:
            told = self._pipe.recv()
            if isinstance(told, Done | Failed):
                return told
            if isinstance(told, Stopping):
                self._stopping = job
            else:
                listener(told)

    def _kill_unless_stopping(self, job: Job) -> None:
        if self.job is job and self._stopping is not job:
            self._killed = True
            self._process.kill()


class Pool:
    """Engine processes taken and given back."""

    def __init__(self, size: int):
        self._idle: queue.LifoQueue[EngineProcess] = queue.LifoQueue()
        for _ in range(size):
            self._idle.put(EngineProcess())

    def take(self) -> EngineProcess:
        """A living engine, compiled; waits for one."""
        engine = self._idle.get()
        if not engine.alive:
            engine = EngineProcess()
        engine.wait_ready()
        return engine

    def give(self, engine: EngineProcess) -> None:
        self._idle.put(engine)
