"""REST endpoints of plans and templates."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from fastapi.responses import Response

from app.access import Role, allowed
from app.calculations.answer import Calculated, Made
from app.calculations.bound import Bound
from app.openapi import PlanData, file, told
from app.plans.dependency import Plans
from app.plans.schemas import CheckOut, TemplateOut
from app.plans.service import PlanService

router = APIRouter(prefix="/api/v1", tags=["plans"])
CHECK = Bound("check of the plan", seconds=10, megabytes=1000, mend="use fewer storeys, stations or samples")
DRIVE = Bound("preview of the drive", seconds=10, megabytes=1000, mend="use fewer points or a shorter drive")
READING = Bound("reading of the YAML", seconds=10, megabytes=1000, mend="send the plan as JSON, or shorten it")
YAML: dict[str, Any] = {"requestBody": {"required": True, "content": {"application/yaml": {"schema": {"type": "string"}}}}}


@router.get("/templates")
@allowed(Role.VIEWER)
def templates(plans: Plans) -> dict[str, Any]:
    """List the templates, each with name, title and group."""
    return {"templates": plans.templates()}


@router.get("/templates/{name}")
@allowed(Role.VIEWER)
def template(name: str, plans: Plans) -> TemplateOut:
    """The plan of a template."""
    return TemplateOut(**plans.template(name))


@router.get("/schema")
@allowed(Role.VIEWER)
def schema(plans: Plans) -> dict[str, Any]:
    """JSON Schema of a plan. Each number has its SI unit, the unit shown to people and the factor between them.

    `measures` and `channels` declare the outputs of a test; `glossary` explains the terms.
    """
    return plans.schema()


@router.post("/plans/check", response_model=CheckOut, responses=told(503))
@allowed(Role.VIEWER)
def check(plan: Annotated[PlanData, Body()], plans: Plans) -> Response:
    """Check a plan without queueing it. The response has every default, the digest, warnings and a summary."""
    return Calculated(CHECK, _checked, plans, plan)


@router.post("/plans/drive", response_model=dict[str, Any], responses=told(503))
@allowed(Role.VIEWER)
def drive(data: Annotated[dict[str, Any], Body()], plans: Plans) -> Response:
    """The displacement of a drive against time, its peak and its largest velocity, for `{drive, controller_rate, duration}`."""
    return Calculated(DRIVE, plans.drive, data)


@router.post("/plans/read", openapi_extra=YAML, response_model=PlanData, responses=told(503))
@allowed(Role.VIEWER)
async def read(request: Request, plans: Plans) -> Response:
    """Convert a plan from YAML to JSON."""
    return Calculated(READING, plans.read, await request.body())


@router.post("/plans/write", response_class=Response, responses=file("application/yaml") | told(503))
@allowed(Role.VIEWER)
def write(plan: Annotated[PlanData, Body()], plans: Plans) -> Response:
    """Convert a plan from JSON to YAML."""
    return Calculated(CHECK, _written, plans, plan)


def _checked(plans: PlanService, plan: Any) -> CheckOut:
    return CheckOut(**plans.check(plan))


def _written(plans: PlanService, plan: Any) -> Made:
    return Made(plans.write(plan).encode(), "application/yaml")
