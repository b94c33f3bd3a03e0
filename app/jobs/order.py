"""The order that a worker gives to the process of a job. Imports nothing, so that the process starts quickly."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Order:
    """The order for one attempt of a job. Each kind of job adds the fields that its process needs; all are pickled."""

    job_id: str
    attempt: int
    moves: bool = field(default=False, kw_only=True)
    """Whether the job can move a machine: its process then stops when its worker is cut off from everybody else."""
