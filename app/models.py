"""Tables of the service. Times are UTC; the name of a number ends with its unit."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.ext.associationproxy import AssociationProxy, association_proxy
from sqlalchemy.orm import Mapped, mapped_column, relationship
from sqlalchemy.orm.attributes import set_committed_value

from app.db import Base, Tags
from app.events.tables import Event as Event
from app.jobs.tables import Job, Ordered
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

LONGEST_VALUE = 200  # characters of a text by which lists sort and filter


def _where(condition: str) -> dict[str, Any]:
    """A partial index in every database."""
    return {"sqlite_where": sa.text(condition), "postgresql_where": sa.text(condition)}


EMULATED = "emulated"
"""The rig of every test that names none: the emulated laboratory of this program."""


class Run(Ordered, Job, Base):
    """One test: rig, state, outcome, measures, checksum and size of its recording, and what people say about it.

    The row is narrow, because lists read every row: `RunPlan` holds the plan, and `RunValue` the values that lists sort and
    filter by. `name` starts as the name of the plan; a new name changes neither plan nor digest.
    An archived run is hidden from lists. A deleted run (`deleted_at`) is hidden too, and is removed after a grace period.
    `pace` is the planned speed factor, null for as fast as possible. `samples` and `size` say how long and how large the test
    is: its expected time follows from earlier runs alike.
    """

    __tablename__ = "run"
    __table_args__ = tuple(sa.Index(f"ix_run_{name}", name) for name in ("submitted_by", "submitted_at", "finished_at"))

    name: Mapped[str] = mapped_column(sa.String(200), index=True)
    template: Mapped[str | None] = mapped_column(sa.String(80), index=True)
    test: Mapped[str] = mapped_column(sa.String(16))
    tags: Mapped[list[str]] = mapped_column(Tags, default=list)
    notes: Mapped[str] = mapped_column(sa.Text, default="")
    archived: Mapped[bool] = mapped_column(default=False)
    deleted_at: Mapped[datetime | None]
    digest: Mapped[str] = mapped_column(sa.String(64), index=True)
    code_version: Mapped[str] = mapped_column(sa.String(40))
    seed: Mapped[int] = mapped_column(sa.BigInteger)
    trip: Mapped[dict[str, Any] | None]
    duration_s: Mapped[float]
    elapsed_s: Mapped[float | None]
    simulated_s: Mapped[float | None]
    rig_id: Mapped[str] = mapped_column(sa.String(36), index=True, default=EMULATED, server_default=EMULATED)
    retry_of: Mapped[str | None] = mapped_column(sa.String(36), index=True)
    pace: Mapped[float | None]
    samples: Mapped[int | None] = mapped_column(sa.BigInteger)
    size: Mapped[str | None] = mapped_column(sa.String(40))
    recording_sha256: Mapped[str | None] = mapped_column(sa.String(64))
    recording_size: Mapped[int | None] = mapped_column(sa.BigInteger)
    library_id: Mapped[str | None] = mapped_column(sa.String(36), index=True)
    library_version: Mapped[int | None]
    rig: Mapped[Rig | None] = relationship(primaryjoin="foreign(Run.rig_id) == Rig.id", viewonly=True, lazy="selectin")
    stations: Mapped[list[RunStation]] = relationship(
        back_populates="run", order_by="RunStation.number", cascade="all, delete-orphan", lazy="selectin"
    )
    planned: Mapped[RunPlan] = relationship(cascade="all, delete-orphan")
    plan: AssociationProxy[dict[str, Any]] = association_proxy("planned", "plan", creator=lambda plan: RunPlan(plan=plan))

    def __init__(self, **values: Any):
        values.setdefault("test", values.get("plan", {}).get("test", "hybrid"))  # an earlier plan without it is hybrid
        super().__init__(**values)

    def on(self, rig: Rig) -> Run:
        """Plan this run for a rig."""
        self.rig_id = rig.id
        set_committed_value(self, "rig", rig)
        return self

    @property
    def rig_name(self) -> str:
        return self.rig.name if self.rig else self.rig_id


class Rig(Base):
    """A rig on which tests run. `tests_at_a_time` is null where any number of tests may run at once.

    `actuators` holds the capacities of the actuators, one for each station in their order: `name`, `stroke` (m), `velocity`
    (m/s) and `force` (N); null where a capacity is not known.
    """

    __tablename__ = "rig"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(80), unique=True)
    kind: Mapped[str] = mapped_column(sa.String(16))
    tests_at_a_time: Mapped[int | None]
    actuators: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    retired: Mapped[bool] = mapped_column(default=False)


class RunPlan(Base):
    """The plan of a run. It is read for one run at a time."""

    __tablename__ = "run_plan"

    run_number: Mapped[int] = mapped_column(sa.ForeignKey("run.number", ondelete="CASCADE"), primary_key=True)
    plan: Mapped[dict[str, Any]]


class ValuePath(Base):
    """The key of a column of the run table whose values stand in `RunValue`: `plan.PATH`, or a measure, `mte_mm:1`."""

    __tablename__ = "value_path"

    id: Mapped[int] = mapped_column(primary_key=True)
    path: Mapped[str] = mapped_column(sa.String(200), unique=True)


class RunValue(Base):
    """A value of a run, number or text, by which lists sort and filter: an index over plans and measures of all runs.

    It follows from `RunPlan` and `RunStation` (app/runs/values.py). Numbers of plans are SI; measures have the unit shown.
    Rows of one path lie together, so that a list reads one column of all runs. There is no foreign key to `run`, because the
    check would need a further index of the same size; the removal of a run removes its values.
    """

    __tablename__ = "run_value"
    __table_args__ = (
        sa.Index("ix_run_value_number", "path_id", "number", "run_number", **_where("number IS NOT NULL")),
        sa.Index("ix_run_value_text", "path_id", "text", "run_number", **_where("text IS NOT NULL")),
        {"sqlite_with_rowid": False},
    )

    path_id: Mapped[int] = mapped_column(sa.ForeignKey("value_path.id"), primary_key=True, autoincrement=False)
    run_number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    number: Mapped[float | None]
    text: Mapped[str | None] = mapped_column(sa.String(LONGEST_VALUE))


class RunView(Base):
    """A saved view of the run table: a name for an address."""

    __tablename__ = "run_view"

    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(sa.String(80), unique=True)
    query: Mapped[str] = mapped_column(sa.Text)
    saved_by: Mapped[str] = mapped_column(sa.String(80))
    saved_at: Mapped[datetime]


class RunStation(Base):
    """One station of a run. Each measure has a column, null where it is not defined or not finite."""

    __tablename__ = "run_station"

    run_number: Mapped[int] = mapped_column(sa.ForeignKey("run.number", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(sa.String(80))
    run: Mapped[Run] = relationship(back_populates="stations")

    def measure(self, key: str) -> float | None:
        """The value of the measure `key`, in the unit shown."""
        value: float | None = getattr(self, key)
        return value


def _add_columns(model: type[Base], scope: type[Measure], kind: type[sa.types.TypeEngine[Any]]) -> None:
    """Add a column for each measure of the scope."""
    for one in of(scope):
        setattr(model, one.key, mapped_column(kind, nullable=True))


_add_columns(RunStation, StationMeasure, sa.Double)
_add_columns(Run, FloorMeasure, sa.JSON)
_add_columns(Run, RunMeasure, sa.Double)


class Annotation(Base):
    """A note of a person at a time of a run, or over a span, on one station or (null) on the whole test."""

    __tablename__ = "annotation"

    row: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    run_number: Mapped[int] = mapped_column(sa.ForeignKey("run.number", ondelete="CASCADE"), index=True)
    from_s: Mapped[float] = mapped_column(sa.Double)
    to_s: Mapped[float | None] = mapped_column(sa.Double)
    station: Mapped[int | None]
    text: Mapped[str] = mapped_column(sa.Text)
    by: Mapped[str] = mapped_column(sa.String(80))
    created_at: Mapped[datetime]
    edited_at: Mapped[datetime | None]


class RawFile(Base):
    """An uploaded file of measurements, stored unchanged under its checksum."""

    __tablename__ = "raw_file"

    sha256: Mapped[str] = mapped_column(sa.String(64), primary_key=True)
    size: Mapped[int] = mapped_column(sa.BigInteger)
    filename: Mapped[str] = mapped_column(sa.String(255))
    uploaded_at: Mapped[datetime] = mapped_column(index=True)


class MeasuredRecording(Base):
    """Measurements imported from a raw file by a mapping. The HDF5 file is complete before the row exists."""

    __tablename__ = "measured_recording"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), index=True)
    test: Mapped[str | None] = mapped_column(sa.String(16))
    raw_sha256: Mapped[str] = mapped_column(sa.ForeignKey("raw_file.sha256"), index=True)
    filename: Mapped[str] = mapped_column(sa.String(255))
    mapping: Mapped[dict[str, Any]]
    channels: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    warnings: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    dt_s: Mapped[float]
    start_s: Mapped[float]
    samples: Mapped[int] = mapped_column(sa.BigInteger)
    imported_by: Mapped[str] = mapped_column(sa.String(80))
    imported_at: Mapped[datetime] = mapped_column(index=True)
    code_version: Mapped[str] = mapped_column(sa.String(40))
    sha256: Mapped[str] = mapped_column(sa.String(64))
    size: Mapped[int] = mapped_column(sa.BigInteger)

    @property
    def rate_hz(self) -> float:
        return 1 / self.dt_s

    @property
    def duration_s(self) -> float:
        return (self.samples - 1) * self.dt_s


class SavedMapping(Base):
    """A mapping saved under a name for files of one layout: of the same format, column names and units."""

    __tablename__ = "saved_mapping"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), unique=True)
    layout: Mapped[str] = mapped_column(sa.String(64), index=True)
    format: Mapped[str] = mapped_column(sa.String(200))
    columns: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    mapping: Mapped[dict[str, Any]]
    saved_by: Mapped[str] = mapped_column(sa.String(80))
    saved_at: Mapped[datetime]


class ImportBatch(Base):
    """Many files imported by one mapping, and the table of what differs between them: a row for each file."""

    __tablename__ = "import_batch"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    mapping: Mapped[dict[str, Any]]
    trust_mapping: Mapped[bool]
    reference: Mapped[str] = mapped_column(sa.Text)
    imported: Mapped[int]
    refused: Mapped[int]
    rows: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    imported_by: Mapped[str] = mapped_column(sa.String(80))
    imported_at: Mapped[datetime]


class Diagnosis(Job, Base):
    """A diagnosis: a job that compares a recording with the models of a plan, and its result after it has completed."""

    __tablename__ = "diagnosis"

    name: Mapped[str] = mapped_column(sa.String(200))
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    level: Mapped[float]
    code_version: Mapped[str] = mapped_column(sa.String(40))
    found: Mapped[str | None] = mapped_column(sa.String(24))
    sentence: Mapped[str | None] = mapped_column(sa.Text)
    verdict: Mapped[dict[str, Any] | None] = mapped_column(sa.JSON(none_as_null=True), deferred=True)
    pictures: Mapped[dict[str, Any] | None] = mapped_column(sa.JSON(none_as_null=True), deferred=True)
    before_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))
    after_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))
    inputs: Mapped[list[DiagnosisInput]] = relationship(
        order_by="DiagnosisInput.place", cascade="all, delete-orphan", lazy="selectin"
    )

    @property
    def recording(self) -> DiagnosisInput:
        return self.inputs[0]

    @property
    def heldout(self) -> list[DiagnosisInput]:
        return self.inputs[1:]


class DiagnosisInput(Base):
    """A recording that a diagnosis reads, imported or from a run. The first is fitted, the others are held out."""

    __tablename__ = "diagnosis_input"

    diagnosis_number: Mapped[int] = mapped_column(sa.ForeignKey("diagnosis.number", ondelete="CASCADE"), primary_key=True)
    place: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    recording_id: Mapped[str | None] = mapped_column(sa.ForeignKey("measured_recording.id"), index=True)
    run_id: Mapped[str | None] = mapped_column(sa.ForeignKey("run.id"))


class LibraryPlan(Base):
    """A plan kept under a name in the library. Its versions are numbered from 1 and never change; `newest` is the last."""

    __tablename__ = "library_plan"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), unique=True)
    newest: Mapped[int]
    created_by: Mapped[str] = mapped_column(sa.String(80))
    created_at: Mapped[datetime]
    changed_at: Mapped[datetime] = mapped_column(index=True)
    archived_by: Mapped[str | None] = mapped_column(sa.String(80))
    archived_at: Mapped[datetime | None]
    versions: Mapped[list[PlanVersion]] = relationship(back_populates="kept", order_by="PlanVersion.number.desc()")
    tagged: Mapped[list[PlanTag]] = relationship(order_by="PlanTag.tag", cascade="all, delete-orphan", lazy="selectin")

    @property
    def tags(self) -> list[str]:
        return [one.tag for one in self.tagged]


class PlanTag(Base):
    """A tag of a plan in the library."""

    __tablename__ = "plan_tag"

    plan_number: Mapped[int] = mapped_column(sa.ForeignKey("library_plan.number", ondelete="CASCADE"), primary_key=True)
    tag: Mapped[str] = mapped_column(sa.String(40), primary_key=True, index=True)


class PlanVersion(Base):
    """One version of a plan in the library. It never changes; `name` and `test` are the plan's own."""

    __tablename__ = "plan_version"

    plan_number: Mapped[int] = mapped_column(sa.ForeignKey("library_plan.number", ondelete="CASCADE"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True)
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    test: Mapped[str] = mapped_column(sa.String(16))
    digest: Mapped[str] = mapped_column(sa.String(64))
    code_version: Mapped[str] = mapped_column(sa.String(40))
    saved_by: Mapped[str] = mapped_column(sa.String(80))
    saved_at: Mapped[datetime]
    comment: Mapped[str] = mapped_column(sa.Text)
    kept: Mapped[LibraryPlan] = relationship(back_populates="versions")


class PlanDraft(Base):
    """A plan as someone types it, valid or not: its owner, its start, and a revision that counts the saves.

    `writer` names the page that saved last; `closed_as` says what became of a draft that is no longer open.
    """

    __tablename__ = "plan_draft"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    owner: Mapped[str] = mapped_column(sa.String(80), index=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    plan: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    problems: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    revision: Mapped[int]
    writer: Mapped[str] = mapped_column(sa.String(40))
    origin_kind: Mapped[str | None] = mapped_column(sa.String(16))
    origin_id: Mapped[str | None] = mapped_column(sa.String(80), index=True)
    origin_version: Mapped[int | None]
    created_at: Mapped[datetime]
    saved_at: Mapped[datetime] = mapped_column(index=True)
    closed_as: Mapped[str | None] = mapped_column(sa.String(16))
    closed_at: Mapped[datetime | None]


class Sweep(Base):
    """Many tests that differ in chosen fields of one plan. `columns` declare the numbers of `SweepPart.values`."""

    __tablename__ = "sweep"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200))
    definition: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    columns: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON, deferred=True)
    method: Mapped[str] = mapped_column(sa.String(24))
    points: Mapped[int]
    cost: Mapped[str] = mapped_column(sa.String(120), index=True)
    code_version: Mapped[str] = mapped_column(sa.String(40))
    submitted_by: Mapped[str] = mapped_column(sa.String(80))
    submitted_at: Mapped[datetime] = mapped_column(index=True)
    cancelled_by: Mapped[str | None] = mapped_column(sa.String(80))


class SweepShard(Job, Base):
    """Consecutive points of a sweep, from `first` (the first point of a sweep is 0), which one process executes."""

    __tablename__ = "sweep_shard"

    sweep_number: Mapped[int] = mapped_column(sa.ForeignKey("sweep.number", ondelete="CASCADE"), index=True)
    first: Mapped[int]
    count: Mapped[int]
    sweep: Mapped[Sweep] = relationship()


class SweepPart(Base):
    """Results of consecutive points of a sweep, stored once: a row of little-endian float64 numbers for each point.

    `reasons` has the reason of each point that did not complete, by its place in the part. The numbers of points that tripped,
    are invalid or failed, and the sums of computing time and simulated time (s), are stored to be counted without the values.
    """

    __tablename__ = "sweep_part"

    sweep_number: Mapped[int] = mapped_column(sa.ForeignKey("sweep.number", ondelete="CASCADE"), primary_key=True)
    first: Mapped[int] = mapped_column(primary_key=True)
    count: Mapped[int]
    values: Mapped[bytes] = mapped_column(sa.LargeBinary, deferred=True)
    reasons: Mapped[dict[str, Any]] = mapped_column(deferred=True)
    tripped: Mapped[int]
    invalid: Mapped[int]
    failed: Mapped[int]
    elapsed_s: Mapped[float]
    simulated_s: Mapped[float]
    stored_at: Mapped[datetime] = mapped_column(index=True)
