"""The service of diagnoses: submit, read, cancel, simulate and delete. It contains no SQL and no HTTP."""

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
    """The service of diagnoses: submit, read, cancel, delete, and run the extended plan."""

    def __init__(self, session: Session, sources: Sources, queue: Queue):
        self.rows = DiagnosisRepository(session)
        self.jobs: JobService[Diagnosis, Diagnosed] = JobService(session, DIAGNOSES, queue)
        self.sources = sources

    @property
    def runs(self) -> RunService:
        return self.sources.runs

    def submit(self, asked: Asked) -> Diagnosis:
        """Store and queue a diagnosis.

        Raises PlanError, RthsError, NotFound or Conflict; then nothing is stored.
        """
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
            raise Conflict("A recording of this diagnosis was deleted. Choose another recording.") from None
        return diagnosis

    def get(self, diagnosis_id: str) -> Diagnosis:
        """The diagnosis of an identifier. Raises NotFound."""
        return self.jobs.get(diagnosis_id)

    def listed(self, limit: int, offset: int) -> tuple[list[Diagnosis], int]:
        return self.rows.listed(limit, offset)

    def result(self, diagnosis_id: str) -> tuple[Diagnosis, Verdict, Pictures]:
        """The diagnosis, its verdict and its plots. Raises Conflict where it has no result."""
        diagnosis = self.get(diagnosis_id)
        if diagnosis.verdict is None or diagnosis.pictures is None:
            raise Conflict(f"The diagnosis has no result: its status is {diagnosis.state}.")
        return diagnosis, Verdict.read(diagnosis.verdict), Pictures.read(diagnosis.pictures)

    def cancel(self, diagnosis_id: str, by: str) -> Diagnosis:
        """Cancel a queued diagnosis now, or ask the worker to stop a running diagnosis.

        Raises IllegalTransition where the diagnosis has already ended.
        """
        return self.jobs.cancel(diagnosis_id, by)

    def remove(self, diagnosis_id: str) -> None:
        """Delete a diagnosis. Raises Conflict where it is queued or running."""
        self.jobs.remove(diagnosis_id)

    def simulate(self, diagnosis_id: str, by: str) -> tuple[Run, Run]:
        """Queue the plan and the extended plan as ordinary runs.

        Raises Conflict where there is no extended plan, or where both runs are queued already, unless a run ended without a
        recording.
        """
        diagnosis = self.jobs.locked(diagnosis_id)
        extended = Verdict.read(diagnosis.verdict).extended_plan if diagnosis.verdict else None
        if extended is None:
            raise Conflict("There is no extended plan to run: no identified effect can be added to this plan.")
        if any(not run.state.ended or run.recording_sha256 for run in self.simulations(diagnosis)):
            raise Conflict("The plan and the extended plan have already been queued.")
        plans = [_called(diagnosis.plan, "before"), _called(extended, "after")]
        before, after = self.runs.submit(plans, by, prefix="extended_plan.{}")
        diagnosis.before_id, diagnosis.after_id = before.id, after.id
        return before, after

    def simulations(self, diagnosis: Diagnosis) -> list[Run]:
        """The runs of the plan and of the extended plan; empty where they were not queued."""
        return [self.runs.get(run_id) for run_id in (diagnosis.before_id, diagnosis.after_id) if run_id]

    def recordings(self, diagnosis: Diagnosis, settings: Settings) -> list[Measured]:
        """The recording and the recordings of both runs; empty until both runs have completed."""
        runs = self.simulations(diagnosis)
        if len(runs) < 2 or any(run.state is not State.COMPLETED for run in runs):
            return []
        paths = [file_of(diagnosis.recording, settings), *(settings.recordings / f"{run.id}.h5" for run in runs)]
        return [load(path) for path in paths]


def _called(plan: dict[str, Any], word: str) -> dict[str, Any]:
    ending = f", {word} diagnosis"
    return {**plan, "name": f"{plan['name'][: LONGEST_NAME - len(ending)]}{ending}"}
