"""The order for the execution of a run, and its outcome. Imports nothing heavy, because the engine process loads it too."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.config import Settings
from app.jobs.order import Order

WAITING = "waiting for client"  # begins what a test with a client does before its client connects


@dataclass(frozen=True, slots=True)
class RunOrder(Order):
    """The order for one execution of a run: plan, local path of the recording, and the settings of the worker.

    The settings say where ground motions and FMUs are stored, and at which address the rig of a test with a client listens.
    """

    plan: dict[str, Any]
    recording: Path
    settings: Settings
    approved: str = ""
    """Digest of the whole plan that was approved (`digest_of`); empty where no approval was needed."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of an execution: summary of the run, and checksum and size (bytes) of its recording."""

    summary: dict[str, Any]
    recording_sha256: str
    recording_size: int


def digest_of(plan: dict[str, Any]) -> str:
    """SHA-256 of a whole plan as stored, pace, name and notes included: what a person approves.

    The digest of the engine covers what decides the result only.
    """
    return hashlib.sha256(json.dumps(plan, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def is_approved(plan: dict[str, Any], digest: str) -> bool:
    """Whether a plan is the one that was approved. The first approvals kept the digest of the engine."""
    from rths_engine.planning.reading import read_plan

    return digest in (digest_of(plan), read_plan(plan).digest)
