"""The facts at the head of a diagnosis, on its page and in its report."""

from __future__ import annotations

from app.models import Diagnosis

LONGEST_NOTES = 400  # characters


def facts(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """The facts above a diagnosis: recording, plan, false-alarm rate, submission and computation time."""
    heldout = ", ".join(one.name for one in diagnosis.heldout)
    took = (diagnosis.finished_at - diagnosis.started_at).total_seconds() if _timed(diagnosis) else None  # type: ignore[operator]
    found = [
        ("Recording", diagnosis.recording.name),
        ("Held-out recordings", heldout),
        ("Plan", diagnosis.plan["name"]),
        ("Notes of the plan", _short(diagnosis.plan.get("notes", ""))),
        ("False-alarm rate", f"{diagnosis.level:g}"),
        ("Submitted", f"{diagnosis.submitted_at:%Y-%m-%d %H:%M} UTC by {diagnosis.submitted_by}"),
        ("Computation time", "" if took is None else f"{took:.1f} s"),
        ("Code version", diagnosis.code_version),
    ]
    return [(name, text) for name, text in found if text]


def _short(text: str) -> str:
    return text if len(text) <= LONGEST_NOTES else f"{text[:LONGEST_NOTES]} …"


def _timed(diagnosis: Diagnosis) -> bool:
    return diagnosis.finished_at is not None and diagnosis.started_at is not None
