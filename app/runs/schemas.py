"""JSON forms of runs."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from app.jobs.states import State
from app.models import Run
from app.text import Storable


class Submission(BaseModel):
    """One plan or a list of plans, and who submits."""

    model_config = ConfigDict(extra="forbid")

    plan: dict[str, Any] | None = None
    plans: list[Any] | None = Field(None, max_length=500)
    submitted_by: Storable = Field("", max_length=80)


class Person(BaseModel):
    """Who asks."""

    model_config = ConfigDict(extra="forbid")

    by: Storable = Field("", max_length=80)


class StationOut(BaseModel):
    """Measures of one station, docs/measures.md."""

    model_config = ConfigDict(from_attributes=True)

    name: str
    mte_mm: float | None
    rms_percent: float | None
    mti_mm2: float | None
    mee_kNm: float | None
    peak_stroke_mm: float | None
    peak_force_kN: float | None
    fei_delay_ms: float | None
    fei_amplitude: float | None
    nrms_percent: float | None
    peak_error_percent: float | None
    delay_ms: float | None
    energy_error_percent: float | None


class RecordingOut(BaseModel):
    """Checksum and size (bytes) of a recording."""

    sha256: str
    size: int


class RunOut(BaseModel):
    """A run without its plan."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    number: int
    name: str
    test: str
    state: State
    digest: str
    code_version: str
    seed: int
    template: str | None
    submitted_by: str
    submitted_at: datetime
    started_at: datetime | None
    finished_at: datetime | None
    attempt: int
    doing: str
    share: float
    reason: str | None
    trip: dict[str, Any] | None
    elapsed_s: float | None
    simulated_s: float | None
    duration_s: float
    stations: list[StationOut]
    floors_peak_mm: list[float | None] | None
    input_energy_kNm: float | None
    recording: RecordingOut | None = None

    @classmethod
    def of(cls, run: Run) -> Self:
        out = cls.model_validate(run)
        if run.recording_sha256 and run.recording_size is not None:
            out.recording = RecordingOut(sha256=run.recording_sha256, size=run.recording_size)
        return out


class RunDetail(RunOut):
    """A run with its plan."""

    plan: dict[str, Any]


class RunList(BaseModel):
    """A page of runs and their number in all."""

    runs: list[RunOut]
    total: int


class Submitted(BaseModel):
    """The runs that were queued."""

    runs: list[RunOut]


class QueueOut(BaseModel):
    """The queue as the Lab page shows it."""

    held: bool
    held_by: str | None
    held_at: datetime | None
    queued: int
    running: list[RunOut]
    worker_seen_at: datetime | None
    worker_alive: bool
