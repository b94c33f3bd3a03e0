"""JSON forms of the run table, of what people say about runs, and of saved views."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StrictBool, StringConstraints

from app.jobs.states import State
from app.runs.columns import Kind
from app.text import PersonName, storable

MOST_TAGS, LONGEST_TAG, LONGEST_NOTES, MOST_SELECTED = 20, 40, 10_000, 500
RESERVED = '|;"'  # they separate tags and conditions

Cell = float | int | bool | str | list[str] | None


class Choice(BaseModel):
    """A value of a choice, and its name for people."""

    value: str
    label: str


class ColumnOut(BaseModel):
    """A column of the run table. Its numbers are in `unit`."""

    key: str = Field(description="names the column in `columns`, `sort` and `where`")
    label: str
    group: str
    kind: Kind
    unit: str
    heading: str = Field(description="label with unit")
    help: str
    choices: list[Choice]


class ColumnList(BaseModel):
    """Every column of which a run has a value, and the columns shown by default."""

    columns: list[ColumnOut]
    default: list[str]


class RowOut(BaseModel):
    """A row of the run table: `cells` are the values in the order of the columns, null where the run has none."""

    id: str
    number: int
    name: str
    state: State
    cells: list[Cell]


class RunTable(BaseModel):
    """A page of the run table."""

    columns: list[ColumnOut]
    rows: list[RowOut]
    total: int = Field(description="number of runs that the filter keeps; at least this number where `exact` is false")
    exact: bool = Field(description="whether `total` is exact: counting stops after 5000 runs that a filter keeps")


def _tag(text: str) -> str:
    if any(one in text for one in RESERVED):
        raise ValueError(f"has one of the characters {' '.join(RESERVED)}, which separate tags and conditions")
    return text


Tag = Annotated[
    str,
    StringConstraints(strip_whitespace=True, min_length=1, max_length=LONGEST_TAG),
    AfterValidator(storable),
    AfterValidator(_tag),
]
Tags = Annotated[list[Tag], Field(max_length=MOST_TAGS)]


class RunChange(BaseModel):
    """What to change in a run; a field that is missing stays. Neither the plan nor its digest changes."""

    model_config = ConfigDict(extra="forbid")

    name: (
        Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200), AfterValidator(storable)] | None
    ) = None
    tags: Tags | None = None
    notes: Annotated[str, StringConstraints(max_length=LONGEST_NOTES), AfterValidator(storable)] | None = None
    archived: StrictBool | None = None


Action = Literal["tag", "untag", "archive", "unarchive", "delete", "restore"]


class BulkChange(BaseModel):
    """One action on several runs. `tags` are those that `tag` adds and `untag` removes."""

    model_config = ConfigDict(extra="forbid")

    action: Action
    runs: list[str] = Field(min_length=1, max_length=MOST_SELECTED)
    tags: Tags = []


class Refusal(BaseModel):
    """A run that was not changed, and the reason."""

    id: str
    reason: str


class BulkResult(BaseModel):
    """The runs that were changed, and those that were not."""

    changed: list[str]
    refused: list[Refusal]


class ViewIn(BaseModel):
    """A view of the run table to save. `query` is the query of its address; a name that exists is replaced."""

    model_config = ConfigDict(extra="forbid")

    name: Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80), AfterValidator(storable)]
    query: Annotated[str, StringConstraints(max_length=8000), AfterValidator(storable)]
    by: PersonName = ""


class ViewOut(BaseModel):
    """A saved view of the run table."""

    model_config = ConfigDict(from_attributes=True)

    id: int
    name: str
    query: str
    saved_by: str
    saved_at: datetime


class ViewList(BaseModel):
    """The saved views of the run table, by name."""

    views: list[ViewOut]


class TagList(BaseModel):
    """Every tag that a run has."""

    tags: list[str]
