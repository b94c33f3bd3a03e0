"""Errors of the client. What the service says is repeated word for word."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Problem:
    """One error in a request: the field (`where`), what is wrong, the value, and how to mend it."""

    where: str
    problem: str
    value: Any = None
    fix: str | None = None

    def __str__(self) -> str:
        said = f"{self.where}: {self.problem}" if self.where else self.problem
        return f"{said} ({self.fix})" if self.fix else said


class ClientError(Exception):
    """Base of all errors of the client."""


class Unreachable(ClientError):
    """The control room did not answer."""


class Refused(ClientError):
    """The control room refused a request: `status` is the HTTP status, `problems` are the errors in the request."""

    def __init__(self, status: int, detail: str, problems: list[Problem]):
        self.status, self.detail, self.problems = status, detail, problems
        super().__init__("; ".join(str(problem) for problem in problems) or detail)


class NotCompleted(ClientError):
    """A job ended as failed, cancelled or tripped although its completion was asked for; `job` is the job."""

    def __init__(self, job: Any):
        self.job = job
        super().__init__(f"{job.name} ended as {job.state}: {job.reason or 'no reason is stored'}")


class TooLong(ClientError):
    """A job did not end within the time to wait. The job goes on."""
