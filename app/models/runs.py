"""Tables of runs: rig, plan, values by which lists sort, saved views, stations and annotations."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.ext.associationproxy import AssociationProxy, association_proxy
from sqlalchemy.orm import Mapped, mapped_column, relationship
from sqlalchemy.orm.attributes import set_committed_value

from app.db import Base, Tags
from app.jobs.tables import Job, Ordered
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

LONGEST_VALUE = 200  # characters of a text by which lists sort and filter


def _where(condition: str) -> dict[str, Any]:
    """A partial index in every database."""
    return {"sqlite_where": sa.text(condition), "postgresql_where": sa.text(condition)}


SORTED = (
    *("state", "name", "tags", "test", "template", "submitted_by", "submitted_at", "started_at", "finished_at"),
    *("duration_s", "simulated_s", "elapsed_s", "attempt", "worker", "seed", "digest", "code_version"),
    *("recording_size", *(one.key for one in of(RunMeasure))),
)
"""Columns by which a list of runs sorts along an index that holds all that a page needs.

`archived` has none: SQLite would take it for the condition of the shelf, and sort.
"""
SHORT = 600  # characters of a text that fit in any case into an entry of an index (PostgreSQL: 2704 bytes)
LONG_TEXTS = ("reason", "notes")
"""Columns of which the index holds the short texts only; a further index holds the numbers of the runs with a long text."""


EMULATED = "emulated"
"""The rig of every test that names none: the emulated laboratory of this program."""


class Run(Ordered, Job, Base):
    """One test: rig, state, outcome, measures, checksum and size of its recording, and what people say about it.

    The row is narrow, because lists read every row: `RunPlan` holds the plan, and `RunValue` the values that lists sort and
    filter by. `name` starts as the name of the plan; a new name changes neither plan nor digest.
    An archived run is hidden from lists. A deleted run (`deleted_at`) is hidden too, and is removed after a grace period.
    `recording_removed_at`: the retention of the laboratory removed the recording; checksum and size are then null.
    `pace` is the planned speed factor, null for as fast as possible. `samples` and `size` say how long and how large the test
    is: its expected time follows from earlier runs alike.
    """

    __tablename__ = "run"

    name: Mapped[str] = mapped_column(sa.String(200))
    template: Mapped[str | None] = mapped_column(sa.String(80))
    test: Mapped[str] = mapped_column(sa.String(16))
    tags: Mapped[list[str]] = mapped_column(Tags, default=list)
    notes: Mapped[str] = mapped_column(sa.Text, default="")
    archived: Mapped[bool] = mapped_column(default=False)
    deleted_at: Mapped[datetime | None]
    digest: Mapped[str] = mapped_column(sa.String(64))
    code_version: Mapped[str] = mapped_column(sa.String(40))
    seed: Mapped[int] = mapped_column(sa.BigInteger)
    trip: Mapped[dict[str, Any] | None]
    client: Mapped[dict[str, Any] | None]
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
    recording_removed_at: Mapped[datetime | None]
    library_id: Mapped[str | None] = mapped_column(sa.String(36), index=True)
    library_version: Mapped[int | None]
    rig: Mapped[Rig | None] = relationship(primaryjoin="foreign(Run.rig_id) == Rig.id", viewonly=True, lazy="selectin")
    stations: Mapped[list[RunStation]] = relationship(
        back_populates="run", order_by="RunStation.number", cascade="all, delete-orphan", lazy="selectin"
    )
    planned: Mapped[RunPlan] = relationship(cascade="all, delete-orphan")
    plan: AssociationProxy[dict[str, Any]] = association_proxy("planned", "plan", creator=lambda plan: RunPlan(plan=plan))
    timing: AssociationProxy[dict[str, Any] | None] = association_proxy("planned", "timing")

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
    """The plan of a run, and the timing of a run in real time. They are read for one run at a time."""

    __tablename__ = "run_plan"

    run_number: Mapped[int] = mapped_column(sa.ForeignKey("run.number", ondelete="CASCADE"), primary_key=True)
    plan: Mapped[dict[str, Any]]
    timing: Mapped[dict[str, Any] | None]


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


def is_short(column: str) -> str:
    """The condition that a text of a run is missing or short."""
    return f"({column} IS NULL OR length({column}) <= {SHORT})"


def is_long(column: str) -> str:
    """The condition that a text of a run is long."""
    return f"length({column}) > {SHORT}"


for _sorted in ("number", *SORTED, *LONG_TEXTS):
    sa.Index(
        f"ix_run_by_{_sorted}",
        *(Run.__table__.c[name] for name in dict.fromkeys([_sorted, "number", "archived", "deleted_at"])),
        **(_where(is_short(_sorted)) if _sorted in LONG_TEXTS else {}),
    )
for _long in LONG_TEXTS:
    sa.Index(f"ix_run_long_{_long}", Run.__table__.c.number, **_where(is_long(_long)))


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
