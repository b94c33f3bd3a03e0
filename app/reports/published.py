"""What Chen and Ricles (2012) publish of a simulation, for a test that is the same simulation."""

from __future__ import annotations

from collections.abc import Iterator

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import templates
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.paper import PAPER, PaperRow
from rths_engine.planning.plan import Plan
from rths_engine.recordings.run_file import Recording

ENDED = ("completed", "tripped")


def published(recording: Recording) -> PaperRow | None:
    """The row of the paper; None for a plan that differs from its template in a decisive field, or a test that was stopped."""
    plan = recording.plan
    row = PAPER.get(plan.template or "")
    if row is None or recording.status not in ENDED:
        return None
    return row if plan.digest in {one.digest for one in _same(plan.template or "")} else None


def _same(template: str) -> Iterator[Plan]:
    """The template, without and with the SHA-256 of its record, which a plan gets when it is queued."""
    plan = templates.template(template)
    yield plan
    if isinstance(plan.motion, RecordMotion):
        record = MotionLibrary(None).get(plan.motion.record)
        yield plan.model_copy(update={"motion": plan.motion.model_copy(update={"sha256": record.sha256})})
