"""What the engine is given to execute a run, and what it returns. Imports nothing heavy: the engine loads it too."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.jobs.order import Order


@dataclass(frozen=True, slots=True)
class RunOrder(Order):
    """One execution of a run: its plan, the file for its recording, and the folder of the laboratory's records."""

    plan: dict[str, Any]
    recording: Path
    motions: Path


@dataclass(frozen=True, slots=True)
class Outcome:
    """How an execution ended: the run's summary, and checksum and size of its recording."""

    summary: dict[str, Any]
    recording_sha256: str
    recording_size: int
