"""The declaration of a kind of job. The job machine (app.jobs and app.worker) does everything else."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import sqlalchemy as sa

from app.config import Settings
from app.jobs.order import Order
from app.jobs.states import State
from app.jobs.tables import Job

Row = TypeVar("Row", bound=Job)
Given = TypeVar("Given", bound=Order)
Result = TypeVar("Result")


class Ending(NamedTuple):
    """The state in which a job ends, and the reason that people read."""

    state: State
    reason: str


class Kind(ABC, Generic[Row, Given, Result]):
    """A kind of job: its table, its queue, the process that executes its jobs, and what a job stores.

    An instance of a subclass is the declaration. `app.worker.kinds.KINDS` lists the kinds that a worker executes.
    """

    name: ClassVar[str]
    """Name of a job in the REST interface, for example "run"."""
    noun: ClassVar[str]
    """Name of a job in reasons and errors, for example "test"."""
    table: ClassVar[type[Job]]
    """The table of the jobs, a subclass of Job; the same as `Row`."""
    queue: ClassVar[str]
    """Name of the durable queue."""
    workflow: ClassVar[str]
    """Name of the durable workflow. Jobs that wait in the queue are lost when it changes."""
    process: ClassVar[str]
    """Module with `prepare()` and `execute(order, line) -> Result`. Only the process imports it; the web service never does."""
    niceness: ClassVar[int] = 0
    """Added to the niceness of the process: kinds with a lower value get the processor first."""
    kept_warm: ClassVar[bool] = False
    """Whether processes start with the worker and stay for the next job; otherwise each job gets a new process."""
    started_early: ClassVar[bool] = True
    """Whether processes that are kept warm start with the worker; otherwise they start with their first job."""
    polling_s: ClassVar[float] = 0.1
    """Time between two polls of the queue, and between two looks at running jobs; each costs a worker a millisecond."""
    ahead: ClassVar[int] = 0
    """Jobs that a worker takes from the queue while all processes are busy, so that no process waits for the next poll."""
    keeps_when_cancelled: ClassVar[bool] = False
    """Whether a cancelled job stores its result so far; otherwise its process is killed at once."""
    ordered: ClassVar[bool] = False
    """Whether people order the jobs of this kind: its table is Ordered, and a delivery starts the first that may start."""
    waits_while_held: ClassVar[bool] = False
    """Whether jobs of this kind wait while the queue is held."""
    told: ClassVar[bool] = True
    """Whether the starts and ends of jobs are events for people; not for jobs that are only shares of a larger one."""
    again: ClassVar[str] = "Submit it again to execute it."
    """What a person does to execute a job again that is not repeated by itself."""
    watched_live: ClassVar[bool] = False
    """Whether the process sends frames and messages to viewers."""

    def at_a_time(self, settings: Settings) -> int:
        """Number of jobs of this kind that one worker executes at the same time."""
        return 1

    def title(self, job: Row) -> str:
        """The name that people gave a job; empty for a kind whose jobs have no names."""
        return ""

    def queued_version(self, job: Row) -> str | None:
        """The version of the program that a job was submitted to, where its kind keeps it."""
        return getattr(job, "code_version", None)

    def not_repeated(self, job: Row) -> str | None:
        """Why a job is not started again after its worker or process died; None where it is."""
        return None

    def may_start(self) -> sa.ColumnElement[bool]:
        """The condition on a queued job of an ordered kind that it may start now; others are passed over meanwhile."""
        return sa.true()

    @abstractmethod
    def order(self, job: Row, settings: Settings) -> Given:
        """The order for the process of a job that has just started."""

    @abstractmethod
    def store(self, job: Row, result: Result) -> Ending:
        """Write a result into the columns of its job. The caller changes the state and commits."""

    def store_part(self, job: Row, part: Any) -> None:
        """Store a part of the result while the job runs. Parts of one attempt come in their order.

        A part comes again where the answer to its commit got lost: it is stored once.
        """
        raise NotImplementedError(f"a {self.name} has no parts")

    def place(self, order: Given, settings: Settings) -> None:
        """Move the files of a result to their final paths, just before the commit. After an OSError the job fails."""

    def discard(self, order: Given) -> None:
        """Remove the temporary files of an attempt, however it ended."""

    def clear(self, job: Row, settings: Settings) -> None:
        """Remove the files of earlier attempts. The caller has locked the job, so no attempt is storing its files now."""
