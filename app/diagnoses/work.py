"""What a worker may do with a diagnosis: start it, tell how far it is, end it. No SQL."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from sqlalchemy.orm import Session

from app import states
from app.diagnoses.repository import DiagnosisRepository
from app.models import Diagnosis
from app.reports.diagnosis_tables import tables
from app.states import State

MOST_ATTEMPTS = 3


@dataclass(frozen=True, slots=True)
class Started:
    """An attempt, and what it works on."""

    diagnosis: Diagnosis
    attempt: int
    plan: dict[str, Any]


class DiagnosisWork:
    def __init__(self, session: Session):
        self.rows = DiagnosisRepository(session)

    def start(self, diagnosis_id: str, worker: str) -> Started | None:
        """Give it to a worker; None when there is nothing to do: ended, cancelled meanwhile, or tried too often."""
        one = self.rows.locked(diagnosis_id)
        if one is None or one.state.ended:
            return None
        if one.state is State.RUNNING:
            _move(one, State.QUEUED)
        if one.cancel_requested_by:
            _end(one, State.CANCELLED, f"Cancelled by {one.cancel_requested_by}; its worker had died.")
            return None
        if one.attempt >= MOST_ATTEMPTS:
            _end(one, State.FAILED, f"Its worker died {one.attempt} times during it; it is not tried again.")
            return None
        _move(one, State.RUNNING)
        one.attempt += 1
        one.worker, one.started_at, one.doing, one.share = worker, datetime.now(UTC), "reading the recording", 0.0
        return Started(one, one.attempt, one.plan)

    def tell(self, diagnosis_id: str, attempt: int, doing: str, share: float) -> None:
        self.rows.tell(diagnosis_id, attempt, doing, share)

    def cancel_requested(self, diagnosis_id: str) -> bool:
        return self.rows.cancel_requested(diagnosis_id)

    def finish(self, diagnosis_id: str, attempt: int, verdict: dict[str, Any], pictures: dict[str, Any]) -> None:
        """Store the result of an attempt, unless another one is under way or someone asked to stop it."""
        one = self._running(diagnosis_id, attempt)
        if one is None:
            return
        if one.cancel_requested_by:
            self._cancelled(one)
            return
        one.verdict, one.pictures = verdict, pictures
        one.found, one.sentence = verdict["verdict"], tables(verdict).sentence
        one.share = 1.0
        _end(one, State.COMPLETED, "Done.")

    def fail(self, diagnosis_id: str, attempt: int, reason: str) -> None:
        one = self._running(diagnosis_id, attempt)
        if one is not None:
            _end(one, State.FAILED, reason)

    def stop(self, diagnosis_id: str, attempt: int) -> None:
        """End an attempt that was stopped because someone asked for it."""
        one = self._running(diagnosis_id, attempt)
        if one is not None:
            self._cancelled(one)

    def _running(self, diagnosis_id: str, attempt: int) -> Diagnosis | None:
        one = self.rows.locked(diagnosis_id)
        return one if one is not None and one.state is State.RUNNING and one.attempt == attempt else None

    def _cancelled(self, one: Diagnosis) -> None:
        _end(one, State.CANCELLED, f"Cancelled by {one.cancel_requested_by}; nothing of it was kept.")


def _move(one: Diagnosis, state: State) -> None:
    states.check(one.state, state)
    one.state = state


def _end(one: Diagnosis, state: State, reason: str) -> None:
    _move(one, state)
    one.reason, one.finished_at, one.doing = reason, datetime.now(UTC), ""
