"""The service of diagnoses: submit, read, cancel, simulate and delete. It contains no SQL and no HTTP."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.config import Settings
from app.diagnoses.job import DIAGNOSES
from app.diagnoses.order import Diagnosed, linear
from app.diagnoses.repository import DiagnosisRepository
from app.diagnoses.schemas import Asked
from app.diagnoses.sources import Sources, file_of
from app.jobs.service import JobService, Queue
from app.jobs.states import State
from app.models import Diagnosis, Run
from app.problems import Conflict
from app.reports.diagnosis_names import capital
from app.reports.diagnosis_overlay import Overlaid
from app.runs.exports import recording_path
from app.runs.service import RunService
from rths_engine import __version__
from rths_engine.diagnosis.schema import Pictures, Verdict
from rths_engine.foundation.errors import PlanError
from rths_engine.planning.connections import emulated
from rths_engine.planning.coupling_checks import not_diagnosed
from rths_engine.planning.reading import read_plan
from rths_engine.recordings.excitation import differences, lead, under_recorded
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
        if plan is not None and (reason := not_diagnosed(plan)) is not None:
            raise PlanError(reason)
        inputs = self.sources.inputs(asked, plan)
        diagnosis = Diagnosis(
            name=asked.name.strip() or inputs[0].name,
            plan=plan.as_dict() if plan else linear(inputs[0].name),
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

    def extended(self, limit: int) -> list[Diagnosis]:
        """Diagnoses that found a mismatch, whose extended plan can be checked; the newest first."""
        return self.rows.extended(limit)

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

    def simulate(self, diagnosis_id: str, by: str, settings: Settings) -> tuple[Run, Run]:
        """Queue the plan and the extended plan as ordinary runs, both under the recorded excitation.

        Raises Conflict where there is no extended plan, or where both runs are queued already, unless a run ended without a
        recording or had another excitation. Raises RthsError where the recording has no excitation for a run.
        """
        diagnosis = self.jobs.locked(diagnosis_id)
        extended = Verdict.read(diagnosis.verdict).extended_plan if diagnosis.verdict else None
        if extended is None:
            raise Conflict("There is no extended plan to run: no identified effect can be added to this plan.")
        queued = self.simulations(diagnosis)
        recorded = any(not run.state.ended or run.recording_sha256 for run in queued)
        if recorded and not self.differences(diagnosis, settings):
            raise Conflict("The plan and the extended plan have already been queued.")
        recording, motions = load(file_of(diagnosis.recording, settings)), self.runs.motions
        pairs = [(read_plan(diagnosis.plan), "before"), (read_plan(extended), "after")]
        plans = [_called(emulated(under_recorded(plan, recording, motions)).as_dict(), word) for plan, word in pairs]
        before, after = self.runs.submit(plans, by, prefix="extended_plan.{}")
        diagnosis.before_id, diagnosis.after_id = before.id, after.id
        return before, after

    def simulations(self, diagnosis: Diagnosis) -> list[Run]:
        """The runs of the plan and of the extended plan; empty where they were not queued."""
        return [self.runs.get(run_id) for run_id in (diagnosis.before_id, diagnosis.after_id) if run_id]

    def differences(self, diagnosis: Diagnosis, settings: Settings) -> str:
        """The reason why the runs cannot be compared with the recording: another excitation. Empty where they can.

        Runs that have not completed are not compared. Raises RthsError where the recording cannot be read.
        """
        runs = self.simulations(diagnosis)
        if not _completed(runs):
            return ""
        recording, motions = load(file_of(diagnosis.recording, settings)), self.runs.motions
        found = {run.name: differences(self.runs.plan_of(run), recording, motions) for run in runs}
        return " ".join(f"{capital(', '.join(map(str, one)))} in the run {name}." for name, one in found.items() if one)

    def overlaid(self, diagnosis: Diagnosis, settings: Settings) -> Overlaid | None:
        """The recording with the recordings of both runs; None until both have completed. Raises RthsError."""
        runs = self.simulations(diagnosis)
        if not _completed(runs):
            return None
        recording = load(file_of(diagnosis.recording, settings))
        before, after = (load(recording_path(run, settings)) for run in runs)
        return Overlaid(recording, before, after, lead(self.runs.plan_of(runs[0]), recording))


def _completed(runs: Sequence[Run]) -> bool:
    return len(runs) == 2 and all(run.state is State.COMPLETED for run in runs)


def _called(plan: dict[str, Any], word: str) -> dict[str, Any]:
    ending = f", {word} diagnosis"
    return {**plan, "name": f"{plan['name'][: LONGEST_NAME - len(ending)]}{ending}"}
