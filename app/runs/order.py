"""The order for the execution of a run, and its outcome. Imports nothing heavy, because the engine process loads it too."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.jobs.order import Order

WAITING = "waiting for client"  # begins what a test with a client does before its client connects


@dataclass(frozen=True, slots=True)
class RunOrder(Order):
    """The order for one execution of a run: plan, path of the recording, and folder of the uploaded ground motions.

    `rig_host` is the address at which the rig of a test with a client listens; `fmus` is the folder of the service's FMUs.
    """

    plan: dict[str, Any]
    recording: Path
    motions: Path
    rig_host: str = "127.0.0.1"
    fmus: Path = Path("fmus")


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of an execution: summary of the run, and checksum and size (bytes) of its recording."""

    summary: dict[str, Any]
    recording_sha256: str
    recording_size: int
