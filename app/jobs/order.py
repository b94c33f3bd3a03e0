"""What a worker gives to the process of a job. Imports nothing, so that the process starts quickly."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Order:
    """One attempt at a job. Each kind of job adds the fields that its process needs; all of them are pickled."""

    job_id: str
    attempt: int
