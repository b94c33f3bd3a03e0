"""The report of a diagnosis, and the facts at its head."""

from __future__ import annotations

from app.models import Diagnosis
from app.reports.diagnosis import Facts, report_html
from rths_engine.diagnosis.schema import Pictures, Verdict

LONGEST_NOTES = 400  # characters


def facts(diagnosis: Diagnosis) -> Facts:
    """The facts above a report: recording, plan, false-alarm rate, submission and computation time."""
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


def report(diagnosis: Diagnosis, verdict: Verdict, pictures: Pictures) -> str:
    """The report of a diagnosis as a stand-alone HTML file."""
    return report_html(diagnosis.name, [*facts(diagnosis), ("Identifier", diagnosis.id)], verdict, pictures, diagnosis.plan)


def _short(text: str) -> str:
    return text if len(text) <= LONGEST_NOTES else f"{text[:LONGEST_NOTES]} …"


def _timed(diagnosis: Diagnosis) -> bool:
    return diagnosis.finished_at is not None and diagnosis.started_at is not None
