"""REST of diagnoses."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query
from fastapi.responses import HTMLResponse, Response

from app.diagnoses import exports
from app.diagnoses.dependency import Diagnoses
from app.diagnoses.schemas import Asked, DiagnosisDetail, DiagnosisList, DiagnosisOut, Simulations
from app.openapi import told
from app.runs.schemas import Person, RunOut
from rths_engine.diagnosis.schema import Pictures, Verdict

router = APIRouter(prefix="/api/v1/diagnoses", tags=["diagnoses"])
NOBODY = Person()


@router.post("", status_code=201, responses=told(404, 409))
def submit(asked: Annotated[Asked, Body()], diagnoses: Diagnoses) -> DiagnosisOut:
    """Queue a diagnosis: what a recording says of the models of a plan."""
    return DiagnosisOut.model_validate(diagnoses.submit(asked))


@router.get("")
def listed(
    diagnoses: Diagnoses,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> DiagnosisList:
    """Newest first."""
    found, total = diagnoses.listed(limit, offset)
    return DiagnosisList(diagnoses=[DiagnosisOut.model_validate(one) for one in found], total=total)


@router.get("/schema")
def schema() -> dict[str, Any]:
    """JSON Schema of a verdict, `rths-diagnosis/1`: every field with its meaning and its unit."""
    return Verdict.json_schema()


@router.get("/pictures-schema")
def pictures_schema() -> dict[str, Any]:
    """JSON Schema of the plots of a diagnosis, `rths-diagnosis-pictures/1`, likewise."""
    return Pictures.json_schema()


@router.get("/{diagnosis_id}")
def one(diagnosis_id: str, diagnoses: Diagnoses) -> DiagnosisDetail:
    """State, progress (`doing`, `share` of the whole) and, once it is done, the verdict."""
    return DiagnosisDetail.model_validate(diagnoses.get(diagnosis_id))


@router.get("/{diagnosis_id}/verdict.json", responses=told(409))
def verdict(diagnosis_id: str, diagnoses: Diagnoses) -> Verdict:
    """`rths-diagnosis/1`."""
    return diagnoses.result(diagnosis_id)[1]


@router.get("/{diagnosis_id}/pictures.json", responses=told(409))
def pictures(diagnosis_id: str, diagnoses: Diagnoses) -> Pictures:
    """`rths-diagnosis-pictures/1`: recording, simulation before and after, and what is left, decimated, SI."""
    return diagnoses.result(diagnosis_id)[2]


@router.get("/{diagnosis_id}/report.html", response_class=HTMLResponse, responses=told(409))
def report(diagnosis_id: str, diagnoses: Diagnoses) -> HTMLResponse:
    """One self-contained page."""
    return HTMLResponse(exports.report(*diagnoses.result(diagnosis_id)))


@router.post("/{diagnosis_id}/cancel", responses=told(409))
def cancel(diagnosis_id: str, diagnoses: Diagnoses, person: Annotated[Person, Body()] = NOBODY) -> DiagnosisOut:
    """End it, queued or running; nothing of it is kept but that it was cancelled."""
    return DiagnosisOut.model_validate(diagnoses.cancel(diagnosis_id, person.by))


@router.post("/{diagnosis_id}/simulations", status_code=201, responses=told(409))
def simulate(diagnosis_id: str, diagnoses: Diagnoses, person: Annotated[Person, Body()] = NOBODY) -> Simulations:
    """Queue the plan and the extended plan as ordinary runs, to be laid over the recording."""
    before, after = diagnoses.simulate(diagnosis_id, person.by)
    return Simulations(before=RunOut.of(before), after=RunOut.of(after))


@router.delete("/{diagnosis_id}", status_code=204, response_class=Response, responses=told(409))
def remove(diagnosis_id: str, diagnoses: Diagnoses) -> None:
    """Remove a diagnosis that has ended, with its result."""
    diagnoses.remove(diagnosis_id)
