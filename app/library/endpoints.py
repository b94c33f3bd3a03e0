"""REST endpoints of the plans in the library."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request
from fastapi import Path as InPath
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import Response
from pydantic import BaseModel, ConfigDict, Field

from app.access import Role, allowed
from app.calculations.answer import Calculated, Made
from app.calculations.bound import Bound
from app.library.dependency import Comparisons, KeptPlans
from app.library.repository import Wanted
from app.library.schemas import (
    Changes,
    Comment,
    Copy,
    DifferencesOut,
    LibraryList,
    LibraryPlanDetail,
    Name,
    NewPlan,
    NewVersion,
    RunsFromPlan,
    SavedOut,
    VersionDetail,
)
from app.library.service import LibraryService
from app.openapi import file, told
from app.plans.dependency import Plans
from app.runs.schemas import Asking
from app.text import PersonName

router = APIRouter(prefix="/api/v1/library", tags=["library of plans"])
YAML: dict[str, Any] = {"requestBody": {"required": True, "content": {"application/yaml": {"schema": {"type": "string"}}}}}
TEXT = Bound("YAML of the plan", seconds=20, megabytes=2000, mend="read the plan as JSON")
DIFFERENCES = Bound("comparison of the plans", seconds=20, megabytes=2000, mend="compare shorter plans")
NumberOfVersion = Annotated[int, InPath(ge=1, le=10**6, description="number of the version, from 1")]


class Listing(BaseModel):
    """Filter, order and page of the list. `q` is looked for in names, tags and comments."""

    model_config = ConfigDict(extra="forbid")

    q: str = Field("", max_length=200)
    tag: str = Field("", max_length=40)
    saved_by: str = Field("", max_length=80)
    archived: bool = False
    sort: str = Field("changed_at", max_length=40)
    order: str = Field("desc", pattern="^(asc|desc)$")
    limit: int = Field(50, ge=1, le=500)
    offset: int = Field(0, ge=0, le=10**9)

    def wanted(self) -> Wanted:
        """The filter, order and page that the repository takes."""
        order = (self.sort, self.order == "desc", self.limit, self.offset)
        return Wanted(self.q.strip(), self.tag, self.saved_by.strip(), self.archived, *order)


class Imported(BaseModel):
    """Name and comment of an imported plan, and the person who imports it."""

    model_config = ConfigDict(extra="forbid")

    name: Name | None = None
    comment: Comment = ""
    saved_by: PersonName = ""


@router.get("/plans")
@allowed(Role.VIEWER)
def listed(wanted: Annotated[Listing, Query()], plans: KeptPlans) -> LibraryList:
    """List the plans in the library with their newest versions, tags, and numbers of runs and drafts."""
    return plans.listed(wanted.wanted())


@router.post("/plans", status_code=201, responses=told(404))
@allowed(Role.ENGINEER)
def save(asked: Annotated[NewPlan, Body()], plans: KeptPlans) -> SavedOut:
    """Keep a valid plan under a name, as version 1."""
    return plans.save(asked)


@router.post("/import", status_code=201, openapi_extra=YAML)
@allowed(Role.ENGINEER)
async def import_yaml(request: Request, about: Annotated[Imported, Query()], plans: KeptPlans, texts: Plans) -> SavedOut:
    """Keep a plan from YAML under a name (default: the name in the plan), as version 1."""
    raw = await request.body()

    def saved() -> SavedOut:
        return plans.save(NewPlan(plan=plans.calculate(TEXT, texts.read, raw), **about.model_dump()))

    return await run_in_threadpool(saved)


@router.get("/plans/{plan_id}")
@allowed(Role.VIEWER)
def one(plan_id: str, plans: KeptPlans) -> LibraryPlanDetail:
    """A plan in the library with all its versions, newest first."""
    return plans.get(plan_id)


@router.patch("/plans/{plan_id}")
@allowed(Role.ENGINEER)
def change(plan_id: str, asked: Annotated[Changes, Body()], plans: KeptPlans) -> LibraryPlanDetail:
    """Rename a plan in the library, or give it other tags. Its versions stay as they are."""
    return plans.change(plan_id, asked)


@router.post("/plans/{plan_id}/versions", status_code=201)
@allowed(Role.ENGINEER)
def save_version(plan_id: str, asked: Annotated[NewVersion, Body()], plans: KeptPlans) -> SavedOut:
    """Save a valid plan as the next version. Equal content makes no new version: `created` is then false."""
    return plans.save_version(plan_id, asked)


@router.get("/plans/{plan_id}/versions/{version}", responses=told(422))
@allowed(Role.VIEWER)
def version(plan_id: str, version: NumberOfVersion, plans: KeptPlans) -> VersionDetail:
    """One version of a plan, with the plan."""
    return plans.version(plan_id, version)


@router.get(
    "/plans/{plan_id}/versions/{version}/plan.yaml",
    response_class=Response,
    responses=file("application/yaml") | told(422, 503),
)
@allowed(Role.VIEWER)
def text(plan_id: str, version: NumberOfVersion, plans: KeptPlans) -> Response:
    """One version of a plan as YAML."""
    return Calculated(TEXT, _text, plans, plan_id, version)


@router.post("/plans/{plan_id}/duplicate", status_code=201)
@allowed(Role.ENGINEER)
def duplicate(plan_id: str, asked: Annotated[Copy, Body()], plans: KeptPlans) -> SavedOut:
    """Keep a copy of a version (default: the newest) as a plan of its own, with the same tags."""
    return plans.duplicate(plan_id, asked)


@router.post("/plans/{plan_id}/archive")
@allowed(Role.ENGINEER)
def archive(plan_id: str, plans: KeptPlans, person: Asking) -> LibraryPlanDetail:
    """Archive a plan: it leaves the list, and all its versions stay stored."""
    return plans.archive(plan_id, person.by)


@router.post("/plans/{plan_id}/unarchive")
@allowed(Role.ENGINEER)
def unarchive(plan_id: str, plans: KeptPlans) -> LibraryPlanDetail:
    """Bring an archived plan back to the list."""
    return plans.unarchive(plan_id)


@router.get("/plans/{plan_id}/runs")
@allowed(Role.VIEWER)
def runs(
    plan_id: str,
    plans: KeptPlans,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> RunsFromPlan:
    """The newest runs that were queued from any version of a plan."""
    return plans.runs(plan_id, limit, offset)


@router.get("/differences", response_model=DifferencesOut, responses=told(404, 503))
@allowed(Role.VIEWER)
def differences(
    comparisons: Comparisons,
    first: Annotated[str, Query(max_length=120)],
    second: Annotated[str, Query(max_length=120)],
) -> Response:
    """The fields in which two plans differ. Each plan is `version:ID:NUMBER`, `run:ID`, `draft:ID` or `template:NAME`."""
    return Calculated(DIFFERENCES, comparisons.differences, first, second)


def _text(plans: LibraryService, plan_id: str, version: int) -> Made:
    headers = {"Content-Disposition": f'attachment; filename="{plan_id}-version-{version}.yaml"'}
    return Made(plans.yaml(plan_id, version).encode(), "application/yaml", headers)
