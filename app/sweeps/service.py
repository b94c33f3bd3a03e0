"""Rules of sweeps: submit, list, cancel, resume, results, and a point as an ordinary run. No SQL, no HTTP."""

from __future__ import annotations

import json
import uuid
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import lru_cache
from hashlib import sha256
from typing import Any

from sqlalchemy.orm import Session

from app.calculations.answer import Calculator
from app.config import Settings
from app.control.service import Control
from app.events.log import EventLog
from app.events.tables import EventKind
from app.jobs.service import JobService, Queue, named
from app.jobs.states import State
from app.models import Run, Sweep, SweepPart, SweepShard
from app.preflight.calculation import DRY_RUN, dry_run
from app.problems import Conflict, NotFound, Unavailable
from app.runs.service import RunService
from app.store.checks import Damaged
from app.sweeps.job import SHARDS, left
from app.sweeps.order import ShardEnd
from app.sweeps.preview import EXAMINATION, Examined, examination
from app.sweeps.repository import Standing, SweepRepository
from app.sweeps.schemas import Duration, PreviewOut
from app.sweeps.shown import axes, column
from rths_engine import __version__
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.sweeps.columns import Column, columns, from_dict
from rths_engine.sweeps.design import Design, read_design
from rths_engine.sweeps.table import POINT, Table, decoded

SHARDS_OF = 20  # shards of a sweep, while they have at most MOST_IN_SHARD points
MOST_IN_SHARD = 200
PREVIEW_S = 1.0  # of points that are examined for a preview
EXAMINED_S = 0.3  # of points that are checked before a sweep is queued


class SweepService:
    """Rules of sweeps."""

    def __init__(
        self, session: Session, runs: RunService, settings: Settings, calculate: Calculator, queue: Queue | None = None
    ):
        self.control, self.events = Control(session), EventLog(session)
        self.rows = SweepRepository(session)
        self.jobs: JobService[SweepShard, ShardEnd] = JobService(session, SHARDS, queue)
        self.runs, self.settings, self.calculate = runs, settings, calculate

    def submit(self, data: Any, by: str) -> Sweep:
        """Store and queue a sweep.

        Raises PlanError with every issue of the definition, and where no examined point is valid.
        """
        design, found = self.calculate(EXAMINATION, examination, data, self.runs.motions, EXAMINED_S)
        if found.examined and found.invalid == found.examined:
            first = found.first_invalid[0]
            raise PlanError(
                [Issue("", f"none of the {found.examined} examined points is valid; point {first.point}: {first.reason}")]
            )
        definition = {**design.definition.as_dict(), "plan": design.plan.as_dict()}
        sweep = Sweep(
            id=str(uuid.uuid4()),
            name=design.definition.name,
            definition=definition,
            columns=[column.as_dict() for column in columns(design)],
            method=design.definition.method,
            points=design.count,
            cost=cost(design),
            code_version=__version__,
            submitted_by=named(by),
            submitted_at=datetime.now(UTC),
        )
        self.rows.add_sweep(sweep)
        self._queue_or_ask(sweep, [(0, design.count)], by)
        return sweep

    def approve(self, sweep_id: str, by: str) -> Sweep:
        """Queue a sweep that was to be approved. Raises Conflict for any other sweep."""
        sweep = self._to_approve(sweep_id)
        sweep.to_approve = False
        self._tell(EventKind.APPROVED, sweep, f"{named(by)} approved it.")
        self._queue(sweep, left([(0, sweep.points)], self.rows.spans(sweep.number, 0, sweep.points)), sweep.submitted_by)
        return sweep

    def reject(self, sweep_id: str, by: str, reason: str) -> Sweep:
        """End a sweep that was to be approved. Raises Conflict for any other sweep."""
        sweep = self._to_approve(sweep_id)
        sweep.to_approve, sweep.cancelled_by = False, named(by)
        self._tell(EventKind.CANCELLED, sweep, f"Rejected by {named(by)}: {reason}")
        return sweep

    def _to_approve(self, sweep_id: str) -> Sweep:
        sweep = self._locked(sweep_id)
        if not sweep.to_approve:
            raise Conflict(f"Sweep {sweep.number} does not wait for approval: it is {state(sweep, self.standing(sweep))}.")
        return sweep

    def _queue_or_ask(self, sweep: Sweep, spans: Sequence[tuple[int, int]], by: str) -> None:
        """Queue points of a sweep, or ask for approval first where the laboratory has this rule."""
        if not self.control.approvals:
            self._queue(sweep, spans, by)
            return
        sweep.to_approve = True
        self.control.ask_approval("sweep", sweep.id, digest(sweep), named(by))
        self._tell(EventKind.TO_APPROVE, sweep, f"{named(by)} submitted it. Another person approves it.")

    def _tell(self, kind: EventKind, sweep: Sweep, sentence: str) -> None:
        self.events.add(kind, f"Sweep {sweep.number}, {sweep.name}: {sentence}", "sweep", sweep.id, sweep.name)

    def preview(self, data: Any) -> PreviewOut:
        """What a sweep would do: its points, columns, stability and computing time. Raises PlanError or MotionError."""
        design, found = self.calculate(EXAMINATION, examination, data, self.runs.motions, PREVIEW_S)
        return PreviewOut(
            name=design.definition.name,
            method=design.definition.method,
            points=design.count,
            axes=axes(design),
            columns=[column(one) for one in columns(design)],
            notes=design.notes,
            examined=found.examined,
            all_examined=found.examined == design.count,
            invalid=found.invalid,
            first_invalid=found.first_invalid,
            stability=found.stability,
            duration=self._duration(design, found),
        )

    def _duration(self, design: Design, found: Examined) -> Duration:
        """The computing time, from the newest points of sweeps of the same kind here, or else from a trial of one point."""
        processes = self.settings.sweep_processes
        elapsed, simulated, points = self.rows.speed(cost(design))
        if simulated > 0 and found.durations_s:
            one: float | None = elapsed / simulated * sum(found.durations_s) / len(found.durations_s)
            basis = f"Speed of the last {points} points of sweeps of this kind on this installation."
        else:
            one = self._trial(design, found)
            basis = "A trial of one point." if one else "Not known: no sweep of this kind ran here, and no trial ended."
        whole = one * -(-design.count // processes) if one else None
        return Duration(point_s=one, processes=processes, predicted_s=whole, basis=basis)

    def _trial(self, design: Design, found: Examined) -> float | None:
        """Computing time (s) of one point, from a dry run; None where it does not answer."""
        if found.first_valid is None:
            return None
        plan = {**design.named(found.first_valid), "pace": {"kind": "fastest"}}
        try:
            answer = self.calculate(DRY_RUN, dry_run, plan, self.runs.motions.folder, [])
        except (RthsError, Unavailable):
            return None
        elapsed: float | None = answer["expected_elapsed_s"]
        return elapsed

    def get(self, sweep_id: str) -> Sweep:
        """The sweep with this id. Raises NotFound."""
        return _found(self.rows.sweep(sweep_id), sweep_id)

    def _locked(self, sweep_id: str) -> Sweep:
        """The sweep with this id as it is now, locked against other writers. Raises NotFound."""
        return _found(self.rows.locked_sweep(sweep_id), sweep_id)

    def listed(self, limit: int, offset: int) -> tuple[list[tuple[Sweep, Standing]], int]:
        found, total = self.rows.listed(limit, offset)
        standings = self.rows.standings([one.number for one in found])
        return [(one, standings[one.number]) for one in found], total

    def standing(self, sweep: Sweep) -> Standing:
        return self.rows.standings([sweep.number])[sweep.number]

    def cancel(self, sweep_id: str, by: str) -> Sweep:
        """Cancel a sweep: shards that wait end now, running shards end within a second.

        Raises Conflict where it has ended, and NotYours where it waits for approval and another person submitted it.
        """
        sweep = self._locked(sweep_id)
        withdrawn = sweep.to_approve and self.control.withdraw(sweep.id, sweep.submitted_by, by)
        ids = self.rows.unfinished(sweep)
        if withdrawn:
            sweep.to_approve = False
        elif not ids:
            raise Conflict(f"The sweep has already ended: it is {state(sweep, self.standing(sweep))}.")
        sweep.cancelled_by = named(by)
        for shard in ids:
            if not self.jobs.locked(shard).state.ended:
                self.jobs.cancel(shard, by)
        return sweep

    def resume(self, sweep_id: str, by: str) -> Sweep:
        """Queue the points without results of a sweep that has ended.

        Raises Conflict where it has not ended, or where no point is left.
        """
        sweep = self._locked(sweep_id)
        standing = self.standing(sweep)
        if sweep.to_approve or any(not one.ended for one in standing.states):
            raise Conflict(f"The sweep has not ended: it is {state(sweep, standing)}. Cancel it first.")
        spans = left([(0, sweep.points)], self.rows.spans(sweep.number, 0, sweep.points))
        if not spans:
            raise Conflict("All points of the sweep have results.")
        sweep.cancelled_by = None
        self._queue_or_ask(sweep, spans, by)
        return sweep

    def remove(self, sweep_id: str) -> None:
        """Delete a sweep that has ended, with its results. Raises Conflict where it has not ended."""
        sweep = self._locked(sweep_id)
        if sweep.to_approve or self.rows.unfinished(sweep):
            raise Conflict("The sweep has not ended. Cancel it first.")
        self.rows.remove_sweep(sweep)

    def table(self, sweep: Sweep, sort: str = POINT, descending: bool = False, statuses: Sequence[str] = ()) -> Table:
        """All results so far. Raises RthsError for a column that does not exist."""
        own = columns_of(sweep)
        if sort not in (POINT, *(column.key for column in own)):
            raise RthsError(Issue("sort", "is not a column of this sweep", sort, f"sort by {POINT} or {own[0].key}"))
        found = decoded(own, [_intact(sweep, one) for one in self.rows.parts(sweep)])
        if statuses:
            place = [column.key for column in own].index("status")
            codes = [float(own[place].categories.index(one)) for one in statuses]
            found = found.taken([value in codes for value in found.values[:, place]])
        return found if sort == POINT and not descending else found.ordered(sort, descending)

    def point(self, sweep: Sweep, number: int) -> tuple[Design, Table]:
        """The design, and the results of one point (counted from 1): an empty table before it is done. Raises NotFound."""
        if not 1 <= number <= sweep.points:
            raise NotFound(f"The sweep has no point {number}: its points are 1 to {sweep.points}.")
        index = number - 1
        parts = self.rows.parts(sweep, index - MOST_IN_SHARD, index + 1)
        found = decoded(columns_of(sweep), [_intact(sweep, one) for one in parts])
        return design_of(sweep), found.taken(found.points == index)

    def run_point(self, sweep_id: str, number: int, by: str) -> Run:
        """Queue the plan of a point as an ordinary run, whose recording has the full histories. Raises NotFound, RthsError."""
        design, _ = self.point(self.get(sweep_id), number)
        return self.runs.submit([design.named(number - 1)], by, prefix="")[0]

    def _queue(self, sweep: Sweep, spans: Sequence[tuple[int, int]], by: str) -> None:
        """Queue shards over spans of points."""
        total = sum(end - first for first, end in spans)
        size = min(MOST_IN_SHARD, max(1, -(-total // SHARDS_OF)))
        shards = [
            SweepShard(sweep_number=sweep.number, first=start, count=min(size, end - start))
            for first, end in spans
            for start in range(first, end, size)
        ]
        self.jobs.submit(shards, by)


def _found(sweep: Sweep | None, sweep_id: str) -> Sweep:
    if sweep is None:
        raise NotFound(f"There is no sweep {sweep_id}.")
    return sweep


def _intact(sweep: Sweep, part: SweepPart) -> tuple[int, int, bytes, dict[str, Any]]:
    """The results of a part. Raises Damaged where they are not those that its checksum was computed of."""
    checksum = sha256(part.values).hexdigest()
    if part.sha256 not in (None, checksum):
        what = f"The results of points {part.first + 1} to {part.first + part.count} of sweep {sweep.number} ({sweep.name})"
        problem = f"{what} are damaged: their SHA-256 is {checksum}; their row states {part.sha256}"
        raise Damaged(Issue("", problem, fix="restore the database from a backup"))
    return part.first, part.count, part.values, part.reasons


def state(sweep: Sweep, standing: Standing) -> State:
    """The state of a sweep, from its shards and its points."""
    if sweep.to_approve:
        return State.TO_APPROVE
    states = standing.states
    if State.RUNNING in states or (State.QUEUED in states and standing.done):
        return State.RUNNING
    if State.QUEUED in states:
        return State.QUEUED
    if standing.done >= sweep.points:
        return State.COMPLETED
    return State.CANCELLED if sweep.cancelled_by else State.FAILED


def digest(sweep: Sweep) -> str:
    """SHA-256 of the definition of a sweep, its plan included."""
    return sha256(json.dumps(sweep.definition, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def cost(design: Design) -> str:
    """What the computing time of a simulated second depends on most; sweeps of the same kind predict each other's time."""
    plan = design.plan
    kinds = sorted({station.specimen.kind for station in plan.stations})
    text = f"{plan.test} {plan.structure.kind} {len(plan.stations)} {'+'.join(kinds)} {plan.controller_rate:g}"
    return text[:120]


def design_of(sweep: Sweep) -> Design:
    """The design of a sweep. Its definition never changes, so it is read once."""
    return _read(sweep.id, json.dumps(sweep.definition))


@lru_cache(maxsize=16)
def _read(_: str, definition: str) -> Design:
    return read_design(json.loads(definition))


def columns_of(sweep: Sweep) -> list[Column]:
    """The columns of the results, as declared when the sweep was submitted."""
    return [from_dict(one) for one in sweep.columns]
