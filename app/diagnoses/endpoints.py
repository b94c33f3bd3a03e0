"""REST endpoints of diagnoses."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query
from fastapi.responses import Response

from app.access import Role, allowed
from app.dependencies import Configured
from app.diagnoses.dependency import Diagnoses
from app.diagnoses.schemas import Asked, DiagnosisDetail, DiagnosisList, DiagnosisOut, Simulations
from app.openapi import told
from app.runs.schemas import Asking, RunOut
from rths_engine.diagnosis.schema import Pictures, Verdict

router = APIRouter(prefix="/api/v1/diagnoses", tags=["diagnoses"])


@router.post("", status_code=201, responses=told(404))
@allowed(Role.ENGINEER)
def submit(asked: Annotated[Asked, Body()], diagnoses: Diagnoses) -> DiagnosisOut:
    """Queue a diagnosis, which compares a recording with the models of a plan."""
    return DiagnosisOut.model_validate(diagnoses.submit(asked))


@router.get("")
@allowed(Role.VIEWER)
def listed(
    diagnoses: Diagnoses,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> DiagnosisList:
    """List diagnoses, the newest first."""
    found, total = diagnoses.listed(limit, offset)
    return DiagnosisList(diagnoses=[DiagnosisOut.model_validate(one) for one in found], total=total)


@router.get("/schema")
@allowed(Role.VIEWER)
def schema() -> dict[str, Any]:
    """JSON Schema of a verdict, `rths-diagnosis/1`, with the meaning and the unit of every field."""
    return Verdict.json_schema()


@router.get("/pictures-schema")
@allowed(Role.VIEWER)
def pictures_schema() -> dict[str, Any]:
    """JSON Schema of the plots of a diagnosis, `rths-diagnosis-pictures/1`, with the meaning and the unit of every field."""
    return Pictures.json_schema()


@router.get("/{diagnosis_id}")
@allowed(Role.VIEWER)
def one(diagnosis_id: str, diagnoses: Diagnoses) -> DiagnosisDetail:
    """Status, progress (`doing`, and `share` from 0 to 1) and, after the diagnosis has completed, the verdict."""
    return DiagnosisDetail.model_validate(diagnoses.get(diagnosis_id))


@router.get("/{diagnosis_id}/verdict.json", responses=told(409))
@allowed(Role.VIEWER)
def verdict(diagnosis_id: str, diagnoses: Diagnoses) -> Verdict:
    """The verdict, `rths-diagnosis/1`."""
    return diagnoses.result(diagnosis_id)[1]


@router.get("/{diagnosis_id}/pictures.json", responses=told(409))
@allowed(Role.VIEWER)
def pictures(diagnosis_id: str, diagnoses: Diagnoses) -> Pictures:
    """The plots, `rths-diagnosis-pictures/1`: recording, simulations before and after, residuals; decimated, in SI units."""
    return diagnoses.result(diagnosis_id)[2]


@router.post("/{diagnosis_id}/cancel")
@allowed(Role.ENGINEER)
def cancel(diagnosis_id: str, diagnoses: Diagnoses, person: Asking) -> DiagnosisOut:
    """Cancel a queued or running diagnosis. Only the status *cancelled* remains."""
    return DiagnosisOut.model_validate(diagnoses.cancel(diagnosis_id, person.by))


@router.post("/{diagnosis_id}/simulations", status_code=201)
@allowed(Role.ENGINEER)
def simulate(diagnosis_id: str, diagnoses: Diagnoses, configured: Configured, person: Asking) -> Simulations:
    """Queue the plan and the extended plan as ordinary runs under the recorded excitation, for comparison with the recording.

    The recorded command, ground motion, floor forces and start replace those of the plan where they differ.
    """
    before, after = diagnoses.simulate(diagnosis_id, person.by, configured)
    return Simulations(before=RunOut.of(before), after=RunOut.of(after))


@router.delete("/{diagnosis_id}", status_code=204, response_class=Response)
@allowed(Role.ENGINEER)
def remove(diagnosis_id: str, diagnoses: Diagnoses) -> None:
    """Delete a diagnosis that has ended, with its result."""
    diagnoses.remove(diagnosis_id)
