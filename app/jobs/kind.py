"""What a kind of job declares. Everything else about it is done by the job machine: app.jobs and app.worker."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, Generic, NamedTuple, TypeVar

from app.config import Settings
from app.jobs.order import Order
from app.jobs.states import State
from app.jobs.tables import Job

Row = TypeVar("Row", bound=Job)
Given = TypeVar("Given", bound=Order)
Result = TypeVar("Result")


class Ending(NamedTuple):
    """The state that a job ends in, and the reason that people read."""

    state: State
    reason: str


class Kind(ABC, Generic[Row, Given, Result]):
    """A kind of job: its table, its queue, the process that executes it and what it stores.

    An instance of a subclass is the declaration; `app.worker.kinds.KINDS` lists those that a worker executes.
    """

    name: ClassVar[str]
    """What the interface calls such a job: "run"."""
    noun: ClassVar[str]
    """What the reasons call such a job: "test"."""
    table: ClassVar[type[Job]]
    """The table of such jobs, a subclass of Job; the same as `Row`."""
    queue: ClassVar[str]
    """Name of the durable queue."""
    workflow: ClassVar[str]
    """Name of the durable workflow. Jobs that wait in the queue are lost when it changes."""
    process: ClassVar[str]
    """Module with `prepare()` and `execute(order, line) -> Result`, imported in the process only: the web never loads it."""
    niceness: ClassVar[int] = 0
    """Added to the niceness of the process, so that kinds with a lower one get the processor first."""
    kept_warm: ClassVar[bool] = False
    """Whether processes start with the worker and stay for the next job; otherwise each job gets a new one."""
    keeps_when_cancelled: ClassVar[bool] = False
    """Whether a cancelled job stores what it has; otherwise its process is killed at once."""
    waits_while_held: ClassVar[bool] = False
    """Whether a held queue holds such jobs."""
    watched_live: ClassVar[bool] = False
    """Whether the process sends frames and messages to viewers."""

    def at_a_time(self, settings: Settings) -> int:
        """How many such jobs one worker executes at a time."""
        return 1

    @abstractmethod
    def order(self, job: Row, settings: Settings) -> Given:
        """What the process needs of a job that has just been started."""

    @abstractmethod
    def store(self, job: Row, result: Result) -> Ending:
        """Write a result into the columns of its job; the caller changes the state and commits."""

    def place(self, order: Given, settings: Settings) -> None:
        """Move the files of a result to their place, just before the commit. May raise OSError: the job then fails."""

    def discard(self, order: Given) -> None:
        """Remove the files of an attempt that are not in their place, however the attempt ended."""

    def clear(self, job: Row, settings: Settings) -> None:
        """Remove the files of earlier attempts. The caller has locked the job, so that none of them is being stored."""
