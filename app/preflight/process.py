"""The process that executes dry runs, so that the web service stays responsive: started at the first preflight, then kept.

It executes one dry run after the other, and ends after IDLE_S without work. A dry run that does not answer is killed.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import threading
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

from app.problems import Unavailable
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning import templates

MODULE = "rths_engine.preflight"
IDENTIFYING = "rths_engine.identification"
IDLE_S = 900.0
START_S = 90.0  # to load or compile the engine
ANSWER_S = 30.0  # of a dry run, which bounds its own time to some seconds
IDENTIFIED_S = 120.0  # of an identification, which simulates and fits its random tests whole
QUEUE_S = 60.0  # wait for the dry runs of other people, and for the engine to load
WAITING = 8  # requests that may wait at the same time
NICENESS = 5  # tests come first


Capacities = tuple[float | None, float | None, float | None]
"""Stroke (m), velocity (m/s) and force (N) of an actuator."""


@dataclass(frozen=True, slots=True)
class Order:
    """A dry run: a checked plan, the folder of records, and the capacities of each station's actuator."""

    plan: dict[str, Any]
    motions: Path | None
    capacities: list[Capacities | None]


@dataclass(frozen=True, slots=True)
class Identification:
    """A random test: a checked plan, the number of its station from 1, and the settings of the test."""

    plan: dict[str, Any]
    station: int
    settings: dict[str, Any]


class DryRuns:
    """A process of dry runs or of identifications, and the pipe to it. `names` is what it executes. Threads may share one."""

    def __init__(self, names: str = "dry runs") -> None:
        self.names = names
        self._process: BaseProcess | None = None
        self._pipe: Connection | None = None
        self._turn = threading.Lock()
        self._waiting = threading.BoundedSemaphore(WAITING)

    def execute(self, order: Order | Identification) -> dict[str, Any]:
        """The answer: a preflight or an identification. Raises PlanError, or Unavailable when no answer comes in time."""
        if not self._waiting.acquire(blocking=False):
            raise Unavailable(f"Too many {self.names} are waiting. Try again in a moment.")
        try:
            if not self._turn.acquire(timeout=QUEUE_S):
                raise Unavailable(f"Other {self.names} took more than {QUEUE_S:g} s. Try again in a moment.")
            try:
                return self._answer(order)
            finally:
                self._turn.release()
        finally:
            self._waiting.release()

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join(2)
        if self._pipe is not None:
            self._pipe.close()
        self._process = self._pipe = None

    def _answer(self, order: Order | Identification) -> dict[str, Any]:
        if isinstance(order, Identification):
            what, patience, mend = "identification", IDENTIFIED_S, "Shorten the random test, or run `rths identify PLAN`."
        else:
            what, patience, mend = "dry run", ANSWER_S, "Shorten the test, or run `rths preflight` on the plan."
        late = f"The {what} did not answer within {patience:g} s. {mend}"
        try:
            pipe = self._ready()
            pipe.send(order)
            if not pipe.poll(patience):
                self.close()
                raise Unavailable(late)
            kind, answer = pipe.recv()
        except (EOFError, OSError):
            self.close()
            raise Unavailable(f"The process of the {self.names} ended unexpectedly. Try again in a moment.") from None
        if kind == "refused":
            raise PlanError(tuple(answer))
        if kind == "failed":
            raise Unavailable(f"The {what} failed: {answer}.")
        found: dict[str, Any] = answer
        return found

    def _ready(self) -> Connection:
        """The pipe to a process that is ready for orders."""
        if self._pipe is not None and self._process is not None and self._process.is_alive():
            return self._pipe
        self.close()
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=serve, args=(theirs,), daemon=True, name="rths-preflight")
        self._process.start()
        theirs.close()
        if not self._pipe.poll(START_S):
            raise OSError("not ready")
        self._pipe.recv()
        return self._pipe


def serve(pipe: Connection) -> None:
    """Execute dry runs until nobody has asked for IDLE_S, or the web service has ended."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
    engine = importlib.import_module(MODULE)
    engine.preflight(templates.template("linear-damper").model_copy(update={"duration": 0.01}))  # loads the compiled loop
    try:
        pipe.send("ready")
        while pipe.poll(IDLE_S):
            pipe.send(_executed(engine, pipe.recv()))
    except (EOFError, OSError):
        return


def _executed(engine: Any, order: Order | Identification) -> tuple[str, Any]:
    from rths_engine.foundation.errors import RthsError
    from rths_engine.parts.ground_motions import MotionLibrary
    from rths_engine.planning.reading import read_model

    try:
        if isinstance(order, Identification):
            identification = importlib.import_module(IDENTIFYING)
            settings = identification.RandomTest.model_validate(order.settings)
            return "done", identification.identify(read_model(order.plan).plan, order.station, settings)
        capacities = [None if one is None else engine.Capacity(*one) for one in order.capacities]
        return "done", engine.preflight(read_model(order.plan), MotionLibrary(order.motions), capacities)
    except RthsError as error:
        issues: tuple[Issue, ...] = tuple(error.issues)
        return "refused", issues
    except Exception as error:
        return "failed", f"{type(error).__name__}: {error}"
