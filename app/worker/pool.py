"""Warm engine processes, one for each test that may run at a time."""

from __future__ import annotations

import multiprocessing
import queue
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from app.worker.engine import Done, Failed, Job, serve

CANCEL_PATIENCE_S = 2.0
Listener = Callable[[Any], None]


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

    def execute(self, job: Job, listener: Listener) -> Done | Failed:
        """Run a job; what the engine tells meanwhile goes to `listener`. A crash of the engine is a Failed."""
        self.job = job
        try:
            self._pipe.send(job)
            while True:
                told = self._pipe.recv()
                if isinstance(told, Done | Failed):
                    return told
                listener(told)
        except (EOFError, OSError):
            self._process.join(CANCEL_PATIENCE_S)
            return Failed(f"The engine process ended unexpectedly (exit code {self._process.exitcode}).")
        finally:
            self.job = None

    def cancel(self) -> None:
        """Ask the engine to stop and keep what it recorded; kill it where it does not answer."""
        job = self.job
        if job is None:
            return
        _send(self._pipe, self._sending, "cancel")
        timer = threading.Timer(CANCEL_PATIENCE_S, self._kill_if_still, args=(job,))
        timer.daemon = True
        timer.start()

    @property
    def alive(self) -> bool:
        return self._process.is_alive()

    def stop(self) -> None:
        self._pipe.close()
        self._process.kill()

    def _kill_if_still(self, job: Job) -> None:
        if self.job is job:
            self._process.kill()


class Pool:
    """Engine processes taken and given back."""

    def __init__(self, size: int):
        self._idle: queue.LifoQueue[EngineProcess] = queue.LifoQueue()
        for _ in range(size):
            self._idle.put(EngineProcess())

    def take(self) -> EngineProcess:
        engine = self._idle.get()
        return engine if engine.alive else EngineProcess()

    def give(self, engine: EngineProcess) -> None:
        self._idle.put(engine)


def _send(pipe: Connection, lock: threading.Lock, message: str) -> None:
    with lock:
        try:
            pipe.send(message)
        except OSError:
            return
