"""Rules of diagnoses as people ask for them: submit, look, cancel, simulate, remove. No SQL, no HTTP."""

from __future__ import annotations

from typing import Any

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.config import Settings
from app.diagnoses.job import DIAGNOSES
from app.diagnoses.order import Diagnosed
from app.diagnoses.repository import DiagnosisRepository
from app.diagnoses.schemas import Asked
from app.diagnoses.sources import Sources, file_of
from app.jobs.service import JobService, Queue
from app.jobs.states import State
from app.models import Diagnosis, Run
from app.problems import Conflict
from app.runs.service import RunService
from rths_engine import __version__
from rths_engine.diagnosis.schema import Pictures, Verdict
from rths_engine.recordings.measured import Measured
from rths_engine.recordings.opening import load

LONGEST_NAME = 200


class DiagnosisService:
    """Rules of diagnoses: submit, cancel, remove, and run the extended plan. No SQL, no HTTP."""

    def __init__(self, session: Session, sources: Sources, queue: Queue):
        self.rows = DiagnosisRepository(session)
        self.jobs: JobService[Diagnosis, Diagnosed] = JobService(session, DIAGNOSES, queue)
        self.sources = sources

    @property
    def runs(self) -> RunService:
        return self.sources.runs

    def submit(self, asked: Asked) -> Diagnosis:
        """Store and queue a diagnosis. Raises PlanError, RthsError, NotFound or Conflict, and stores nothing."""
        plan = self.sources.plan(asked)
        inputs = self.sources.inputs(asked, plan)
        diagnosis = Diagnosis(
            name=asked.name.strip() or inputs[0].name,
            plan=plan.as_dict(),
            level=asked.level,
            code_version=__version__,
            inputs=inputs,
        )
        try:
            self.jobs.submit([diagnosis], asked.submitted_by)
        except IntegrityError:
            raise Conflict("A recording was removed meanwhile.") from None
        return diagnosis

    def get(self, diagnosis_id: str) -> Diagnosis:
        """Raises NotFound."""
        return self.jobs.get(diagnosis_id)

    def listed(self, limit: int, offset: int) -> tuple[list[Diagnosis], int]:
        return self.rows.listed(limit, offset)

    def result(self, diagnosis_id: str) -> tuple[Diagnosis, Verdict, Pictures]:
        """The diagnosis, its verdict and its pictures. Raises Conflict while there are none."""
        diagnosis = self.get(diagnosis_id)
        if diagnosis.verdict is None or diagnosis.pictures is None:
            raise Conflict(f"The diagnosis is {diagnosis.state} and has no result.")
        return diagnosis, Verdict.read(diagnosis.verdict), Pictures.read(diagnosis.pictures)

    def cancel(self, diagnosis_id: str, by: str) -> Diagnosis:
        """End a queued one now; ask the worker to end a running one. Raises IllegalTransition for an ended one."""
        return self.jobs.cancel(diagnosis_id, by)

    def remove(self, diagnosis_id: str) -> None:
        """Raises Conflict while it is under way."""
        self.jobs.remove(diagnosis_id)

    def simulate(self, diagnosis_id: str, by: str) -> tuple[Run, Run]:
        """Queue the plan and the extended plan as ordinary runs, once unless one of them came to nothing."""
        diagnosis = self.jobs.locked(diagnosis_id)
        extended = Verdict.read(diagnosis.verdict).extended_plan if diagnosis.verdict else None
        if extended is None:
            raise Conflict("There is no extended plan to run: the diagnosis names no effect that the plan has a place for.")
        if any(not run.state.ended or run.recording_sha256 for run in self.simulations(diagnosis)):
            raise Conflict("The plan and the extended plan are queued already.")
        plans = [_called(diagnosis.plan, "before"), _called(extended, "after")]
        before, after = self.runs.submit(plans, by, prefix="extended_plan.{}")
        diagnosis.before_id, diagnosis.after_id = before.id, after.id
        return before, after

    def simulations(self, diagnosis: Diagnosis) -> list[Run]:
        """The runs before and after, where they were queued."""
        return [self.runs.get(run_id) for run_id in (diagnosis.before_id, diagnosis.after_id) if run_id]

    def recordings(self, diagnosis: Diagnosis, settings: Settings) -> list[Measured]:
        """The recording, and those of the runs before and after; none until both have run to their end."""
        runs = self.simulations(diagnosis)
        if len(runs) < 2 or any(run.state is not State.COMPLETED for run in runs):
            return []
        paths = [file_of(diagnosis.recording, settings), *(settings.recordings / f"{run.id}.h5" for run in runs)]
        return [load(path) for path in paths]


def _called(plan: dict[str, Any], word: str) -> dict[str, Any]:
    ending = f", {word} diagnosis"
    return {**plan, "name": f"{plan['name'][: LONGEST_NAME - len(ending)]}{ending}"}
