"""The dependency that gives each request its service of diagnoses."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.dependencies import OneSession
from app.diagnoses.repository import DiagnosisRepository
from app.diagnoses.service import DiagnosisService
from app.diagnoses.sources import Sources
from app.measured.dependency import Recordings
from app.plans.dependency import Plans
from app.runs.dependency import Runs


def diagnosis_service(
    request: Request, session: OneSession, runs: Runs, recordings: Recordings, plans: Plans
) -> DiagnosisService:
    """The service of diagnoses in the session of the request."""
    return DiagnosisService(session, Sources(runs, recordings, plans, DiagnosisRepository(session)), request.app.state.queue)


Diagnoses = Annotated[DiagnosisService, Depends(diagnosis_service)]
