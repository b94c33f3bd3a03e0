"""JSON forms of sweeps."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.jobs.states import State
from app.openapi import PlanData
from app.text import PersonName

SWEEP_SAID = "A sweep, `rths-sweep/1`: a plan (or the name of a template), the fields that vary, records and scales"
SweepData = Annotated[dict[str, Any], Field(description=SWEEP_SAID)]  # read by the engine, whose errors name the field


class SweepSubmission(BaseModel):
    """A sweep, and the person who submits it."""

    model_config = ConfigDict(extra="forbid")

    sweep: SweepData
    submitted_by: PersonName = ""


class ColumnOut(BaseModel):
    """A column of the results. Values are in the unit `shown`; with `categories` they are one of these texts.

    `role` is input, intensity, outcome or measure. A measure belongs to a station or a floor (`scope`, `number`, `name`), or
    to the whole run, and `measure` is its key.
    """

    key: str
    label: str
    shown: str
    shown_label: str
    role: Literal["input", "intensity", "outcome", "measure"]
    scope: str
    number: int | None
    name: str
    measure: str
    decimals: int | None
    categories: list[str]


class AxisOut(BaseModel):
    """One varied field as it was read. `values` are in the unit shown, null for a distribution; texts for choices."""

    path: str
    label: str
    shown: str
    shown_label: str
    change: Literal["set", "multiply"]
    fields: list[str] = Field(description="every field of the plan that gets the value")
    planned: float | str | None = Field(description="the value of the plan itself, in the unit shown")
    values: list[float | str] | None
    lowest: float | None = Field(description="smallest value among the points, in the unit shown")
    highest: float | None = Field(description="largest value among the points, in the unit shown")


class Refusal(BaseModel):
    """A point that is not valid, or is predicted unstable, and the reason."""

    point: int
    inputs: dict[str, float | str | None]
    reason: str


class Prediction(BaseModel):
    """The stability prediction of the examined points."""

    predicted: int = Field(description="points for which stability about rest was predicted")
    stable: int
    unstable: int
    first_unstable: list[Refusal]


class Duration(BaseModel):
    """The predicted computing time; null where no speed of this machine is known yet."""

    point_s: float | None = Field(description="computing time of one point in one process, s")
    processes: int = Field(description="processes that execute points")
    predicted_s: float | None = Field(description="time from the first point to the last, s, while nothing else runs")
    basis: str = Field(description="what the prediction is made from")


class PreviewOut(BaseModel):
    """A sweep before it is queued.

    `examined` points, all or a random sample, were checked like plans before they are queued; `invalid` of them are not valid.
    """

    name: str
    method: str
    points: int
    axes: list[AxisOut]
    columns: list[ColumnOut]
    notes: list[str]
    examined: int
    all_examined: bool
    invalid: int
    first_invalid: list[Refusal]
    stability: Prediction
    duration: Duration


class SweepOut(BaseModel):
    """A sweep without its definition. `done` points have results: completed, tripped, invalid or failed ones.

    `remaining_s` is predicted from the points done; null where nothing runs.
    """

    id: str
    number: int
    name: str
    method: str
    state: State
    points: int
    done: int
    completed: int
    tripped: int
    invalid: int
    failed: int
    share: float = Field(description="share of the points that is done, 0 to 1")
    remaining_s: float | None
    elapsed_s: float | None = Field(description="time from the start of the first point, s")
    reason: str | None
    submitted_by: str
    submitted_at: datetime
    started_at: datetime | None
    finished_at: datetime | None
    code_version: str


class SweepDetail(SweepOut):
    """A sweep with its definition, whose plan is complete, and the declarations of its columns."""

    sweep: SweepData
    axes: list[AxisOut]
    columns: list[ColumnOut]
    notes: list[str]


class SweepList(BaseModel):
    """A page of sweeps, the newest first, and the total number."""

    sweeps: list[SweepOut]
    total: int


class ResultsOut(BaseModel):
    """A page of results in columns: `values` holds a list for each column, by its key, with `point` first and `reason` last.

    `total` is the number of points with results that the filter leaves, of `points` in the sweep.
    """

    columns: list[ColumnOut]
    values: dict[str, list[float | str | None]]
    offset: int
    total: int
    points: int


class PointOut(BaseModel):
    """One point: its inputs in the units shown, its results (null before it is done), and its plan."""

    point: int
    inputs: dict[str, float | str | None]
    results: dict[str, float | str | None] | None
    reason: str | None
    plan: PlanData


class PlanField(BaseModel):
    """A number of a plan: its path, label, unit, value and bounds (SI), and the factor from the unit shown to SI."""

    path: str
    label: str
    unit: str
    shown: str
    shown_label: str
    factor: float
    whole: bool
    value: float | None
    lowest: float | None
    highest: float | None


class PlanFields(BaseModel):
    """The numbers of a plan that a sweep can vary, in the order of the plan."""

    fields: list[PlanField]
