"""JSON forms of the library of plans."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints

from app.jobs.states import State
from app.openapi import Issue, PlanData
from app.text import Integer, PersonName, Storable, integer, storable

LONGEST_COMMENT, MOST_TAGS = 2000, 20
By = Annotated[PersonName, Field(description="the person who makes the request")]
Name = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200), AfterValidator(storable)]
Tag = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=40), AfterValidator(storable)]
Tags = Annotated[list[Tag], Field(max_length=MOST_TAGS)]
Comment = Annotated[Storable, Field(max_length=LONGEST_COMMENT, description="what changed in this version")]
Text = Annotated[str, Field(max_length=80)]


class _Asked(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _Stored(BaseModel):
    model_config = ConfigDict(from_attributes=True)


class NewPlan(_Asked):
    """A plan to keep in the library. Without `name` it gets the name that the plan itself has."""

    plan: PlanData
    name: Name | None = None
    comment: Comment = ""
    tags: Tags = []
    saved_by: By = ""
    draft: Text | None = Field(None, description="id of the draft that this plan was typed in; it is closed as saved")


class NewVersion(_Asked):
    """A further version of a plan."""

    plan: PlanData
    comment: Comment = ""
    saved_by: By = ""
    draft: Text | None = Field(None, description="id of the draft that this version was typed in; it is closed as saved")


class Changes(_Asked):
    """A new name or new tags; what is left out stays."""

    name: Name | None = None
    tags: Tags | None = None


class Copy(_Asked):
    """A duplicate of a version (default: the newest) under a name (default: the name with 'copy')."""

    name: Name | None = None
    version: Annotated[int, Field(strict=True, ge=1, le=10**6), BeforeValidator(integer)] | None = None
    saved_by: By = ""


class VersionOut(_Stored):
    """One version of a plan, without the plan. `name` and `test` are those in the plan."""

    number: int
    name: str
    test: str
    digest: str
    saved_by: str
    saved_at: datetime
    comment: str
    runs: int = Field(0, description="number of runs that were queued from this version")


class LibraryPlanOut(_Stored):
    """A plan in the library with its newest version."""

    id: str
    name: str
    tags: list[str]
    created_by: str
    created_at: datetime
    changed_at: datetime
    archived_by: str | None
    archived_at: datetime | None
    versions: int
    runs: int = Field(description="number of runs that were queued from any version")
    drafts: int = Field(description="number of open drafts that started from any version")
    newest: VersionOut


class LibraryPlanDetail(LibraryPlanOut):
    """A plan in the library with all its versions, newest first."""

    history: list[VersionOut]


class TagOut(BaseModel):
    """A tag, and the number of plans that have it."""

    tag: str
    plans: int


class LibraryList(BaseModel):
    """A page of plans, their total number, and every tag in use."""

    plans: list[LibraryPlanOut]
    total: int
    tags: list[TagOut]


class VersionDetail(VersionOut):
    """One version of a plan with the plan."""

    library_id: str
    library_name: str
    plan: PlanData


class SavedOut(BaseModel):
    """The version that holds the plan. `created` is false where a version with equal content was there already."""

    id: str
    name: str
    version: VersionOut
    created: bool


class RunFromVersion(_Stored):
    """A run that was queued from a version. `changed` says whether its plan computes something else than the version."""

    id: str
    number: int
    name: str
    state: State
    reason: str | None
    submitted_by: str
    submitted_at: datetime
    finished_at: datetime | None
    version: int
    changed: bool


class RunsFromPlan(BaseModel):
    """The newest runs that were queued from a plan, and their total number."""

    runs: list[RunFromVersion]
    total: int


class Origin(_Asked):
    """What a draft started from: a version of a plan in the library, a template or a run."""

    model_config = ConfigDict(extra="forbid", from_attributes=True)

    kind: Literal["version", "template", "run"]
    id: Storable = Field(max_length=80, description="id of the plan or the run, or the name of the template")
    version: Annotated[int, Field(strict=True, ge=1, le=10**6), BeforeValidator(integer)] | None = Field(
        None, description="number of the version"
    )


DraftPlan = Annotated[dict[str, Any], Field(description="the plan as typed; it need not be valid")]
Writer = Annotated[Storable, Field(max_length=40, description="name of the page that saves, to tell two windows apart")]


class DraftIn(_Asked):
    """The plan as typed now, what it started from, and the revision of the draft that it changes."""

    plan: DraftPlan
    revision: Integer = Field(
        ge=0,
        le=2**31 - 1,
        description="the revision that was changed; 0 for a new draft",
    )
    owner: By = ""
    writer: Writer = ""
    origin: Origin | None = Field(None, description="stored with a new draft; it does not change later")


class Closing(_Asked):
    """What became of a draft: discarded, or queued as a run."""

    closed_as: Literal["discarded", "queued"] = "discarded"


class DraftProblem(Issue):
    """Something in a draft that is not valid, with the label of its field, and the unit of the value and the bound."""

    title: str
    unit: str


class DraftOut(_Stored):
    """A draft without its plan. `problems` says what is not valid (the first 20 problems)."""

    id: str
    owner: str
    name: str = Field(description="the name in the plan, where it has one")
    revision: int
    writer: str
    problems: list[DraftProblem]
    origin: Origin | None
    origin_title: str = Field("", description="what the draft started from, in words")
    created_at: datetime
    saved_at: datetime
    closed_as: Literal["discarded", "queued", "saved"] | None
    closed_at: datetime | None


class DraftDetail(DraftOut):
    """A draft with its plan as typed."""

    plan: DraftPlan


class DraftList(BaseModel):
    """Drafts, last saved first."""

    drafts: list[DraftOut]


class ComparedOut(BaseModel):
    """One of the compared plans: what it is called, in short and in full, and the page that shows it."""

    label: str
    title: str
    page: str


class DifferenceOut(_Stored):
    """A field in which two plans differ. `values` are SI, null where a plan has no such field; `texts` are in `unit`."""

    path: str
    within: str
    label: str
    title: str = Field(description="the label with the names of the parts around it")
    unit: str
    values: tuple[Any, Any]
    texts: tuple[str, str]


class DifferencesOut(BaseModel):
    """The compared plans, and the fields in which they differ in the order of a plan; none: the plans are equal."""

    items: list[ComparedOut]
    differences: list[DifferenceOut]
