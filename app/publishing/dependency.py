"""The services of reports of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.annotations.dependency import Annotations
from app.compare.dependency import Comparisons
from app.dependencies import Configured
from app.diagnoses.dependency import Diagnoses
from app.laboratory.dependency import OneLaboratory
from app.publishing.others import ComparisonReports, DiagnosisReports, SweepReports
from app.publishing.runs import RunReports
from app.runs.dependency import Runs
from app.sweeps.dependency import Sweeps


def run_reports(runs: Runs, annotations: Annotations, laboratory: OneLaboratory, configured: Configured) -> RunReports:
    """The reports of runs in the session of the request."""
    return RunReports(runs, annotations, laboratory, configured)


def diagnosis_reports(diagnoses: Diagnoses, laboratory: OneLaboratory) -> DiagnosisReports:
    """The reports of diagnoses in the session of the request."""
    return DiagnosisReports(diagnoses, laboratory)


def comparison_reports(comparisons: Comparisons, laboratory: OneLaboratory) -> ComparisonReports:
    """The reports of comparisons in the session of the request."""
    return ComparisonReports(comparisons, laboratory)


def sweep_reports(sweeps: Sweeps, laboratory: OneLaboratory) -> SweepReports:
    """The reports of sweeps in the session of the request."""
    return SweepReports(sweeps, laboratory)


OfComparisons = Annotated[ComparisonReports, Depends(comparison_reports)]
OfSweeps = Annotated[SweepReports, Depends(sweep_reports)]
OfRuns = Annotated[RunReports, Depends(run_reports)]
OfDiagnoses = Annotated[DiagnosisReports, Depends(diagnosis_reports)]
