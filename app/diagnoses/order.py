"""The order and the result of the process of a diagnosis. That process loads this module too, so it imports nothing heavy."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.jobs.order import Order
from rths_engine.diagnosis.schema import Pictures, Verdict


@dataclass(frozen=True, slots=True)
class DiagnosisOrder(Order):
    """One attempt at a diagnosis: plan, file of the recording, files of the held-out recordings, false-alarm rate."""

    plan: dict[str, Any]
    recording: Path
    heldout: tuple[Path, ...]
    level: float


@dataclass(frozen=True, slots=True)
class Diagnosed:
    """The verdict (`rths-diagnosis/1`) and its pictures (`rths-diagnosis-pictures/1`)."""

    verdict: Verdict
    pictures: Pictures
