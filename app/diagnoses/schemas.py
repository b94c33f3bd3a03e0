"""JSON forms of diagnoses."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict, Field

from app.jobs.states import State
from app.openapi import PlanData
from app.runs.schemas import RunOut
from app.text import Storable
from rths_engine.diagnosis.schema import Verdict

MOST_HELD_OUT = 20


class Source(BaseModel):
    """A recording: one that was imported, or that of a run."""

    model_config = ConfigDict(extra="forbid")

    recording: Storable | None = Field(None, max_length=36)
    run: Storable | None = Field(None, max_length=36)


class Asked(BaseModel):
    """A recording to hold against a plan: given as JSON or as text in YAML, of a template, of a run, or the recording's own."""

    model_config = ConfigDict(extra="forbid")

    recording: Source
    heldout: list[Source] = Field([], max_length=MOST_HELD_OUT)
    plan: PlanData | str | None = None
    template: Storable | None = Field(None, max_length=80)
    plan_of_run: Storable | None = Field(None, max_length=36)
    level: float = Field(0.01, gt=0, le=0.5, description="rate of false alarms")
    name: Storable = Field("", max_length=200)
    submitted_by: Storable = Field("", max_length=80)


class InputOut(BaseModel):
    """A recording that a diagnosis uses: imported, or the recording of a run."""

    model_config = ConfigDict(from_attributes=True)

    name: str
    recording_id: str | None
    run_id: str | None


class DiagnosisOut(BaseModel):
    """A diagnosis without its plan and its result.

    `found` is the verdict's kind; `before_id` and `after_id` are the runs of the plan and of the extended plan.
    """

    model_config = ConfigDict(from_attributes=True)

    id: str
    name: str
    state: State
    doing: str
    share: float
    reason: str | None
    found: str | None
    sentence: str | None
    recording: InputOut
    heldout: list[InputOut]
    level: float
    submitted_by: str
    submitted_at: datetime
    started_at: datetime | None
    finished_at: datetime | None
    attempt: int
    code_version: str
    before_id: str | None
    after_id: str | None


class DiagnosisDetail(DiagnosisOut):
    """A diagnosis with its plan and, once it is done, its verdict (`rths-diagnosis/1`)."""

    plan: PlanData
    verdict: Verdict | None


class DiagnosisList(BaseModel):
    """A page of diagnoses and their number in all."""

    diagnoses: list[DiagnosisOut]
    total: int


class Simulations(BaseModel):
    """The runs of the plan as it was and of the extended plan."""

    before: RunOut
    after: RunOut
