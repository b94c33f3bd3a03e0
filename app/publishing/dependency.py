"""The services of reports of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.annotations.dependency import Annotations
from app.dependencies import Configured
from app.diagnoses.dependency import Diagnoses
from app.laboratory.dependency import OneLaboratory
from app.publishing.others import DiagnosisReports
from app.publishing.runs import RunReports
from app.runs.dependency import Runs


def run_reports(runs: Runs, annotations: Annotations, laboratory: OneLaboratory, configured: Configured) -> RunReports:
    """The reports of runs in the session of the request."""
    return RunReports(runs, annotations, laboratory, configured)


def diagnosis_reports(diagnoses: Diagnoses, laboratory: OneLaboratory) -> DiagnosisReports:
    """The reports of diagnoses in the session of the request."""
    return DiagnosisReports(diagnoses, laboratory)


OfRuns = Annotated[RunReports, Depends(run_reports)]
OfDiagnoses = Annotated[DiagnosisReports, Depends(diagnosis_reports)]
