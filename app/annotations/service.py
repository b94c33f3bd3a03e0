"""Rules of annotations: they lie within the test and name one of its stations. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.annotations.repository import AnnotationRepository
from app.annotations.schemas import AnnotationList, AnnotationOut, Written
from app.jobs.states import State
from app.models import Annotation, Run
from app.problems import Conflict, NotFound
from app.runs.exports import removed
from app.runs.service import RunService
from rths_engine.foundation.errors import Issue, RthsError

MOST = 200  # annotations of a run
SPARE = 1.0  # s beyond the planned end of a running test: a trip is stated one sample later
ROUNDED = 1e-3  # s: times come from a page that rounds them


class AnnotationService:
    """Writes, lists, edits and deletes annotations of runs."""

    def __init__(self, session: Session, runs: RunService):
        self.rows, self.runs = AnnotationRepository(session), runs

    def listed(self, run_id: str) -> AnnotationList:
        """The annotations of a run, numbered in order of time. Raises NotFound."""
        rows = self.rows.of(self.runs.get(run_id).number)
        return AnnotationList(annotations=[_out(row, number) for number, row in enumerate(rows, start=1)])

    def add(self, run_id: str, written: Written) -> AnnotationOut:
        """Add an annotation. Raises NotFound, Conflict for too many or without a recording, and RthsError outside the test."""
        run = self.runs.jobs.locked(run_id)
        _check(run, written)
        if len(self.rows.of(run.number)) >= MOST:
            raise Conflict(f"The run has {MOST} annotations, the most that a report shows. Delete one first.")
        row = Annotation(id=str(uuid.uuid4()), run_number=run.number, created_at=datetime.now(UTC), **_fields(written))
        self.rows.add(row)
        return self._numbered(row)

    def edit(self, run_id: str, annotation_id: str, written: Written) -> AnnotationOut:
        """Replace an annotation. Raises NotFound, Conflict without a recording, and RthsError outside the test."""
        run = self.runs.get(run_id)
        _check(run, written)
        row = self._row(run, annotation_id)
        for name, value in _fields(written).items():
            setattr(row, name, value)
        row.edited_at = datetime.now(UTC)
        return self._numbered(row)

    def remove(self, run_id: str, annotation_id: str) -> None:
        """Delete an annotation. Raises NotFound."""
        self.rows.remove(self._row(self.runs.get(run_id), annotation_id))

    def _row(self, run: Run, annotation_id: str) -> Annotation:
        """An annotation of a run as it is now, locked against other writers. Raises NotFound."""
        found = self.rows.locked(run.number, annotation_id)
        if found is None:
            raise NotFound(f"The run has no annotation {annotation_id}.")
        return found

    def _numbered(self, row: Annotation) -> AnnotationOut:
        return _out(row, 1 + [one.id for one in self.rows.of(row.run_number)].index(row.id))


def _out(row: Annotation, number: int) -> AnnotationOut:
    own = {name: getattr(row, name) for name in AnnotationOut.model_fields if name != "number"}
    return AnnotationOut(**own, number=number)


def _fields(written: Written) -> dict[str, object]:
    return {**written.model_dump(), "text": written.text.strip(), "by": written.by.strip()}


def _end(run: Run) -> tuple[float, float]:
    """The end of a test (s), and the last time that a person may annotate. Raises Conflict where nothing is recorded."""
    if run.state is State.RUNNING:
        return run.duration_s, run.duration_s + SPARE
    if run.recording_sha256 is None or run.simulated_s is None:
        until = "after its start" if run.state is State.QUEUED else "of a run with a recording"
        said = removed(run) or f"Run #{run.number} is {run.state} and has no recording to annotate."
        raise Conflict(f"{said} Annotate a time {until}.")
    tripped = run.trip["time_s"] if run.trip else 0.0
    return run.simulated_s, max(run.simulated_s, tripped) + ROUNDED


def _check(run: Run, written: Written) -> None:
    issues = []
    end, last = _end(run)
    for name, time in (("from_s", written.from_s), ("to_s", written.to_s)):
        if time is not None and time > last:
            issues.append(Issue(name, f"is after the end of the test at {end:.2f} s", time, "choose a time of the test"))
    if written.to_s is not None and written.to_s <= written.from_s:
        issues.append(
            Issue("to_s", f"needs a time after from_s = {written.from_s:g} s", written.to_s, "leave it out for a single time")
        )
    stations = len(run.plan.get("stations", ()))
    if written.station is not None and written.station > stations:
        problem = f"needs a station from 1 to {stations}" if stations else "the test has no station"
        issues.append(Issue("station", problem, written.station, "leave it out to annotate the whole test"))
    if not written.text.strip():
        issues.append(Issue("text", "is empty", fix="write what happened"))
    if issues:
        raise RthsError(issues)
