"""JSON forms of diagnoses."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict, Field

from app.jobs.states import State
from app.openapi import PlanData
from app.runs.schemas import RunOut
from app.text import PersonName, Storable
from rths_engine.diagnosis.schema import Verdict

MOST_HELD_OUT = 20


class Source(BaseModel):
    """A recording, given by the identifier of an imported recording or of a run."""

    model_config = ConfigDict(extra="forbid")

    recording: Storable | None = Field(None, max_length=36)
    run: Storable | None = Field(None, max_length=36)


class Asked(BaseModel):
    """A recording and the plan to compare it with.

    The plan is JSON or YAML text (`plan`), a template (`template`), the plan of a run (`plan_of_run`), the extended plan of a
    diagnosis (`extended_plan_of`), or a linear model that is fitted to the recording (`linear`). Without these, it is the plan
    of the run that made the recording. `heldout` recordings are never fitted.
    """

    model_config = ConfigDict(extra="forbid")

    recording: Source
    heldout: list[Source] = Field([], max_length=MOST_HELD_OUT)
    plan: PlanData | str | None = None
    template: Storable | None = Field(None, max_length=80)
    plan_of_run: Storable | None = Field(None, max_length=36)
    extended_plan_of: Storable | None = Field(None, max_length=36)
    linear: bool = Field(
        False,
        description="true: check a spring and dashpot, a first-order delay or a shear building that is fitted to the recording",
    )
    level: float = Field(
        0.01, gt=0, le=0.5, description="false-alarm rate: probability of a mismatch where the models of the plan are right"
    )
    name: Storable = Field("", max_length=200)
    submitted_by: PersonName = ""


class InputOut(BaseModel):
    """A recording that a diagnosis uses: imported, or the recording of a run."""

    model_config = ConfigDict(from_attributes=True)

    name: str
    recording_id: str | None
    run_id: str | None


class DiagnosisOut(BaseModel):
    """A diagnosis without its plan and its result.

    `found` is the kind of the verdict, and `sentence` its first sentence. `before_id` and `after_id` are the runs of the plan
    and of the extended plan.
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
    """A diagnosis with its plan and, after it has completed, its verdict (`rths-diagnosis/1`).

    Until a linear model has been fitted, `plan` is its name and `fitted: linear`.
    """

    plan: PlanData
    verdict: Verdict | None


class DiagnosisList(BaseModel):
    """A page of diagnoses and the total number of diagnoses."""

    diagnoses: list[DiagnosisOut]
    total: int


class Simulations(BaseModel):
    """The runs of the plan (`before`) and of the extended plan (`after`)."""

    before: RunOut
    after: RunOut
