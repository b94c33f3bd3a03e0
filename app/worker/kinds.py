"""The kinds of job that a worker executes. Each kind is one line here."""

from __future__ import annotations

from typing import Any

from app.diagnoses.job import DIAGNOSES
from app.jobs.kind import Kind
from app.runs.job import RUNS
from app.sweeps.job import SHARDS

KINDS: tuple[Kind[Any, Any, Any], ...] = (RUNS, DIAGNOSES, SHARDS)
