"""The order and the result of the process of a diagnosis. That process loads this module too, so it imports nothing heavy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from app.config import Settings
from app.jobs.order import Order
from app.store.filed import Filed
from rths_engine.diagnosis.schema import Pictures, Verdict


@dataclass(frozen=True, slots=True)
class DiagnosisOrder(Order):
    """One attempt at a diagnosis: plan, file of the recording, files of the held-out recordings, false-alarm rate.

    The plan is None for a linear model, which the process fits to the recording named `name`.
    """

    plan: dict[str, Any] | None
    name: str
    recording: Filed
    heldout: tuple[Filed, ...]
    level: float
    settings: Settings


def linear(recording: str) -> dict[str, Any]:
    """The stored plan of a diagnosis whose linear model is not fitted yet."""
    return {"name": f"Linear model fitted to {recording}", "fitted": "linear"}


@dataclass(frozen=True, slots=True)
class Diagnosed:
    """The compared plan, the verdict (`rths-diagnosis/1`) and its pictures (`rths-diagnosis-pictures/1`)."""

    plan: dict[str, Any]

    verdict: Verdict
    pictures: Pictures
