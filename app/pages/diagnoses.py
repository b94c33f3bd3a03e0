"""The pages of diagnoses: the list with the form of a new diagnosis, and one diagnosis with its progress and result."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Request
from fastapi.responses import HTMLResponse

from app.access import Role, allowed
from app.calculations.answer import Calculating
from app.calculations.bound import Bound
from app.config import Settings
from app.dependencies import Configured
from app.diagnoses.dependency import Diagnoses
from app.diagnoses.exports import facts
from app.diagnoses.service import DiagnosisService
from app.jobs.states import State
from app.measured.dependency import Recordings
from app.models import Diagnosis
from app.pages.errors import PageRoute
from app.pages.rendering import page, plotted
from app.plans.dependency import Plans
from app.reports.diagnosis import shown
from app.reports.diagnosis_overlay import overlay
from app.runs.dependency import Runs
from app.runs.repository import Filter, Page
from rths_engine.foundation.errors import RthsError

LIMIT = 50
OFFERED = 200  # recordings, and runs
RECORDED = (State.COMPLETED, State.TRIPPED, State.CANCELLED)

RESULT = Bound("result of the diagnosis", seconds=60, megabytes=4000, mend="download its report")

router = APIRouter(route_class=PageRoute, default_response_class=HTMLResponse, include_in_schema=False)


@router.get("/diagnoses")
@allowed(Role.VIEWER)
def listed(
    request: Request,
    diagnoses: Diagnoses,
    recordings: Recordings,
    runs: Runs,
    plans: Plans,
    recording: str = "",
    run: str = "",
    plan: str = "",
    number: Annotated[int, Query(alias="page", ge=1, le=10**6)] = 1,
) -> HTMLResponse:
    """The list of diagnoses with the form. `recording` or `run`, and the `plan` to check, are preselected in the form."""
    found, total = diagnoses.listed(LIMIT, LIMIT * (number - 1))
    recorded = [one for one in runs.listed(Filter(states=RECORDED), Page(limit=OFFERED))[0] if one.recording_sha256]
    if run and all(one.id != run for one in recorded):
        recorded.insert(0, runs.get(run))
    imported = recordings.listed(OFFERED, 0)[0]
    if recording and all(one.id != recording for one in imported):
        imported.insert(0, recordings.get(recording))
    offered: dict[str, Any] = {"imported": imported, "recorded": recorded, "templates": plans.templates()}
    offered["extended"] = diagnoses.extended(OFFERED)
    chosen = f"run:{run}" if run else f"recording:{recording}" if recording else ""
    part: dict[str, Any] = {"diagnoses": found, "total": total, "number": number, "first": LIMIT * (number - 1) + 1}
    plan = plan or ("linear" if recording else "own")
    return page(request, "diagnoses.html", chosen=chosen, plan=plan, **offered, **part)


@router.get("/diagnoses/{diagnosis_id}")
@allowed(Role.VIEWER)
def one(
    request: Request, diagnosis_id: str, diagnoses: Diagnoses, configured: Configured, calculate: Calculating
) -> HTMLResponse:
    """The page of a diagnosis."""
    diagnosis = diagnoses.get(diagnosis_id)
    result: dict[str, Any] = {}
    if diagnosis.verdict is not None and diagnosis.pictures is not None:
        result = {
            **calculate(RESULT, _result, diagnoses, diagnosis_id, configured),
            "simulations": diagnoses.simulations(diagnosis),
        }
    return plotted(request, "diagnosis.html", diagnosis=diagnosis, facts=facts(diagnosis), result=result, **result)


def _result(diagnoses: DiagnosisService, diagnosis_id: str, configured: Settings) -> dict[str, Any]:
    """The verdict in words and numbers, and its plots."""
    diagnosis, verdict, pictures = diagnoses.result(diagnosis_id)
    extended = verdict.extended_plan is not None
    return {
        **shown(verdict, pictures, diagnosis.plan),
        "extended": extended,
        **_overlaid(diagnosis, diagnoses, configured),
    }


def _overlaid(diagnosis: Diagnosis, diagnoses: DiagnosisService, configured: Settings) -> dict[str, Any]:
    """The plots over the recording, or the reason why they are missing: an unreadable file does not fail the page."""
    empty: dict[str, Any] = {"overlay": [], "not_overlaid": "", "not_alike": ""}
    try:
        if different := diagnoses.differences(diagnosis, configured):
            return {**empty, "not_alike": different}
        found = diagnoses.overlaid(diagnosis, configured)
    except RthsError as error:
        return {**empty, "not_overlaid": str(error)}
    return {**empty, "overlay": overlay(found) if found else []}
