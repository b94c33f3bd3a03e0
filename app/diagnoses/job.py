"""Diagnoses as a kind of job: one at a time, each in its own process with a lower priority than tests."""

from __future__ import annotations

from app.config import Settings
from app.diagnoses.order import Diagnosed, DiagnosisOrder
from app.diagnoses.sources import filed
from app.jobs.kind import Ending, Kind
from app.jobs.states import State
from app.models import Diagnosis
from app.reports.diagnosis_tables import tables


class DiagnosisKind(Kind[Diagnosis, DiagnosisOrder, Diagnosed]):
    """Diagnoses as a kind of job: executed one after another, with a lower priority than tests."""

    name = noun = "diagnosis"
    table = Diagnosis
    queue, workflow = "diagnoses", "diagnose"
    process = "app.worker.diagnosis"
    niceness = 10
    polling_s = 0.25  # a cancelled diagnosis stops within half a second

    def title(self, job: Diagnosis) -> str:
        return job.name

    def order(self, job: Diagnosis, settings: Settings) -> DiagnosisOrder:
        first, *others = [filed(given) for given in job.inputs]
        plan = None if "fitted" in job.plan else job.plan
        return DiagnosisOrder(job.id, job.attempt, plan, job.recording.name, first, tuple(others), job.level, settings)

    def store(self, job: Diagnosis, result: Diagnosed) -> Ending:
        job.plan = result.plan
        job.verdict, job.pictures = result.verdict.as_dict(), result.pictures.as_dict()
        job.found, job.sentence = result.verdict.verdict, tables(result.verdict, job.plan).sentence
        return Ending(State.COMPLETED, "Done.")


DIAGNOSES = DiagnosisKind()
