"""JSON forms of runs."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING, Annotated, Any, Self

from fastapi import Body
from pydantic import BaseModel, ConfigDict, Field, create_model

from app.jobs.states import State
from app.measures import fields
from app.models import EMULATED, Run
from app.openapi import PLAN, PlanData
from app.text import Integer, PersonName, Storable
from rths_engine.foundation.part import validated
from rths_engine.planning.connections import sentences
from rths_engine.planning.plan import Plan
from rths_engine.results.measure import FloorMeasure, RunMeasure, StationMeasure


class FromLibrary(BaseModel):
    """The version of a plan in the library that a submitted plan was opened from."""

    model_config = ConfigDict(extra="forbid")

    id: Storable = Field(max_length=36)
    version: Integer = Field(ge=1, le=10**6)


class Submission(BaseModel):
    """One plan or a list of plans, the person who submits, and the version in the library that the plans were opened from."""

    model_config = ConfigDict(extra="forbid")

    plan: PlanData | None = None
    plans: list[Annotated[Any, PLAN]] | None = Field(None, max_length=500)
    submitted_by: PersonName = ""
    library: FromLibrary | None = None
    rig: Storable = Field(EMULATED, max_length=36, description="id of the rig; by default the emulated laboratory")
    priority: Integer = Field(0, ge=-1, le=2, description="2 urgent, 1 high, 0 normal, -1 low")


class Person(BaseModel):
    """The person who makes the request."""

    model_config = ConfigDict(extra="forbid")

    by: PersonName = ""


Asking = Annotated[Person, Body(default_factory=Person)]
"""The person in the body of a request, which may be left out."""


class _Named(BaseModel):
    model_config = ConfigDict(from_attributes=True)

    name: str = Field(description="name of the station")


if TYPE_CHECKING:
    _StationMeasured = _Named
else:
    _StationMeasured = create_model("StationMeasured", __base__=_Named, **fields(StationMeasure, float))


class StationOut(_StationMeasured):
    """The measures of one station in the units shown; null where a measure is not defined or not known."""


class RecordingOut(BaseModel):
    """Checksum and size (bytes) of a recording."""

    sha256: str
    size: int


class StepTimes(BaseModel):
    """Wall times of the steps of a client (ms); null for fewer than two steps."""

    median: float | None
    p95: float | None = Field(description="95 % of the steps took at most this time")
    longest: float | None


class ClientOut(BaseModel):
    """The client of a test: another program that computed the structure, and how its steps went."""

    address: str = Field(description="address at which the rig listened")
    transport: str
    peer: str = Field(description="address of the client")
    steps: int
    messages: dict[str, int] = Field(description="number of messages by action code")
    step_ms: StepTimes
    iterations: int = Field(description="displacements within a step that the rig did not follow")
    unfollowed_m: float = Field(
        description="largest difference (m) between a committed displacement and the command of the rig"
    )
    waits: int = Field(description="ramps in real time that began late, because the client had not sent its displacement")
    longest_wait_s: float = Field(description="longest of these waits (s)")
    warnings: list[str]
    ended: str = Field(description="why the test ended, as a sentence")


class _Known(BaseModel):
    model_config = ConfigDict(from_attributes=True)

    id: str
    number: int
    name: str
    test: str
    state: State
    digest: str
    code_version: str = Field(description="version of the program that the run was submitted to")
    started_version: str | None = Field(description="version of the program of the last start; null before the first")
    seed: int
    template: str | None
    library_id: str | None
    library_version: int | None
    rig_id: str
    rig_name: str
    priority: int
    retry_of: str | None = Field(description="id of the first run of this plan that was retried")
    submitted_by: str
    submitted_at: datetime
    started_at: datetime | None
    finished_at: datetime | None
    attempt: int
    doing: str
    share: float
    reason: str | None
    trip: dict[str, Any] | None
    client: ClientOut | None = Field(None, description="the client of a test with a client, once the test has ended")
    elapsed_s: float | None
    simulated_s: float | None
    duration_s: float
    stations: list[StationOut]
    tags: list[str]
    notes: str
    archived: bool
    deleted_at: datetime | None
    recording_removed_at: datetime | None = Field(description="when retention removed the recording; null: it did not")


if TYPE_CHECKING:
    _RunMeasured = _Known
else:
    _RunMeasured = create_model(
        "RunMeasured", __base__=_Known, **fields(FloorMeasure, list[float | None]), **fields(RunMeasure, float)
    )


class RunOut(_RunMeasured):
    """A run without its plan."""

    recording: RecordingOut | None = None

    @classmethod
    def of(cls, run: Run) -> Self:
        out = cls.model_validate(run)
        if run.recording_sha256 and run.recording_size is not None:
            out.recording = RecordingOut(sha256=run.recording_sha256, size=run.recording_size)
        return out


class RunDetail(RunOut):
    """A run with its plan and, of a test in real time, its timing."""

    plan: PlanData
    timing: dict[str, Any] | None = Field(
        None, description="deadlines of the controller steps of a test in real time; docs/deadlines.md describes each key"
    )
    external: list[str] = Field([], description="what each external station of the plan is, as a sentence")
    undo_until: datetime | None = Field(None, description="until when the cancel of the test can be undone; null: it can't be")

    @classmethod
    def of(cls, run: Run, undo_until: datetime | None = None) -> Self:
        out = super().of(run)
        out.undo_until = undo_until
        if any(station.get("connection", {}).get("kind", "emulated") != "emulated" for station in run.plan["stations"]):
            out.external = sentences(validated(Plan, run.plan))
        return out


class RunList(BaseModel):
    """A page of runs, and the total number."""

    runs: list[RunOut]
    total: int


class Submitted(BaseModel):
    """The runs that were queued."""

    runs: list[RunOut]
