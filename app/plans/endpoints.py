"""REST endpoints of plans and templates."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import PlainTextResponse, Response

from app.openapi import PlanData, file
from app.plans.dependency import Plans
from app.plans.schemas import CheckOut, TemplateOut

router = APIRouter(prefix="/api/v1", tags=["plans"])
YAML: dict[str, Any] = {"requestBody": {"required": True, "content": {"application/yaml": {"schema": {"type": "string"}}}}}


@router.get("/templates")
def templates(plans: Plans) -> dict[str, Any]:
    """List the templates, each with name, title and group."""
    return {"templates": plans.templates()}


@router.get("/templates/{name}")
def template(name: str, plans: Plans) -> TemplateOut:
    """The plan of a template."""
    return TemplateOut(**plans.template(name))


@router.get("/schema")
def schema(plans: Plans) -> dict[str, Any]:
    """JSON Schema of a plan. Each number has its SI unit, the unit shown to people and the factor between them.

    `measures` and `channels` declare the outputs of a test; `glossary` explains the terms.
    """
    return plans.schema()


@router.post("/plans/check")
def check(plan: Annotated[PlanData, Body()], plans: Plans) -> CheckOut:
    """Check a plan without queueing it. The response has every default, the digest, warnings and a summary."""
    return CheckOut(**plans.check(plan))


@router.post("/plans/drive")
def drive(data: Annotated[dict[str, Any], Body()], plans: Plans) -> dict[str, Any]:
    """The displacement of a drive against time, its peak and its largest velocity, for `{drive, controller_rate, duration}`."""
    return plans.drive(data)


@router.post("/plans/read", openapi_extra=YAML)
async def read(request: Request, plans: Plans) -> PlanData:
    """Convert a plan from YAML to JSON."""
    return await run_in_threadpool(plans.read, await request.body())


@router.post("/plans/write", response_class=Response, responses=file("application/yaml"))
def write(plan: Annotated[PlanData, Body()], plans: Plans) -> PlainTextResponse:
    """Convert a plan from JSON to YAML."""
    return PlainTextResponse(plans.write(plan), media_type="application/yaml")
