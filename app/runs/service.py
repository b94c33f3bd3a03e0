"""Rules of runs: submit, cancel, abort, and what a worker may do with one. No SQL, no HTTP."""

from __future__ import annotations

import difflib
import json
import uuid
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any, Protocol

from sqlalchemy.orm import Session

from app import states
from app.checking import Checked, checked
from app.models import Run, RunStation
from app.problems import NotFound
from app.runs.repository import MEASURES, SORTS, Filter, Page, RunRepository
from app.runs.schemas import QueueOut, RunOut
from app.states import State
from rths_engine import __version__
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan

MOST_ATTEMPTS = 3
WORKER_SILENCE = timedelta(seconds=6)
NOBODY = "unnamed"


class Queue(Protocol):
    """The durable queue, as far as submitting needs it."""

    def enqueue(self, session: Session, run_ids: Sequence[str]) -> None: ...


@dataclass(frozen=True, slots=True)
class Outcome:
    """How an execution ended: the run's summary, and checksum and size of its recording."""

    summary: dict[str, Any]
    recording_sha256: str
    recording_size: int


class RunService:
    def __init__(self, session: Session, motions: MotionLibrary, queue: Queue | None = None):
        self.runs = RunRepository(session)
        self.session, self.motions, self.queue = session, motions, queue

    def submit(self, plans: Sequence[Any], submitted_by: str, prefix: str = "plans.{}") -> list[Run]:
        """Check every plan, store and queue all, or raise PlanError with every issue and store nothing."""
        if not plans:
            raise PlanError(Issue("plans", "there is no plan to run", fix="give one plan or more"))
        issues: list[Issue] = []
        runs: list[Run] = []
        for index, data in enumerate(plans):
            try:
                runs.append(_queued(checked(data, self.motions), submitted_by.strip() or NOBODY))
            except RthsError as error:
                issues += [_under(prefix.format(index), issue) for issue in error.issues]
        if issues:
            raise PlanError(issues)
        self.runs.add(runs)
        assert self.queue is not None
        self.queue.enqueue(self.session, [run.id for run in runs])
        return runs

    def get(self, run_id: str) -> Run:
        run = self.runs.get(run_id)
        if run is None:
            raise NotFound(f"There is no run {run_id}.")
        return run

    def plan_of(self, run: Run) -> Plan:
        return read_plan(run.plan)

    def listed(self, wanted: Filter, page: Page) -> tuple[list[Run], int]:
        column, _, station = page.sort.partition(":")
        numbered = station.isdecimal() and len(station) < 3
        known = column in MEASURES if numbered else column in SORTS and page.sort == column
        if not known:
            names = [*SORTS, *(f"{name}:STATION" for name in MEASURES)]
            near = difflib.get_close_matches(page.sort, names, 1)
            raise RthsError(Issue("sort", "is no column to sort by", page.sort, f"try {near[0]}" if near else ", ".join(names)))
        return self.runs.listed(wanted, page)

    def queue_state(self) -> QueueOut:
        state, seen = self.runs.queue_state(), self.runs.last_beat()
        return QueueOut(
            held=state.held,
            held_by=state.held_by,
            held_at=state.held_at,
            queued=self.runs.count(State.QUEUED),
            running=[RunOut.of(run) for run in self.runs.in_states(State.RUNNING)],
            worker_seen_at=seen,
            worker_alive=worker_alive(seen),
        )

    def cancel(self, run_id: str, by: str) -> Run:
        """End a queued run now; ask the worker to end a running one. Raises IllegalTransition for an ended one."""
        run = self.runs.locked(run_id) or self.get(run_id)
        by = by.strip() or NOBODY
        states.check(run.state, State.CANCELLED)
        if run.state is State.QUEUED:
            self._end(run, State.CANCELLED, f"Cancelled by {by} before it started.")
        else:
            run.cancel_requested_by = by
        return run

    def abort(self, by: str) -> list[Run]:
        """Hold the queue and ask every running test to stop. A run that a worker is just starting finds the queue held."""
        by = by.strip() or NOBODY
        self.runs.hold(by)
        stopping = []
        for running in self.runs.in_states(State.RUNNING):
            run = self.runs.locked(running.id)
            if run is not None and run.state is State.RUNNING:
                run.cancel_requested_by = by
                stopping.append(run)
        return stopping

    def release(self) -> None:
        self.runs.release()

    def start(self, run_id: str, worker: str) -> Run | None:
        """Give the run to a worker, or None when there is nothing to do: ended, cancelled meanwhile, or tried too often.

        Workers come here while the queue is not held; if it is held now, an abort fell on the run's start and ends it.
        """
        queue = self.runs.locked_queue()
        run = self.runs.locked(run_id)
        if run is None or run.state.ended:
            return None
        if run.state is State.RUNNING:
            self._move(run, State.QUEUED)
        if run.cancel_requested_by:
            self._end(run, State.CANCELLED, f"Cancelled by {run.cancel_requested_by}; its worker or engine had died.")
            return None
        if queue.held:
            self._end(run, State.CANCELLED, f"Stopped by {queue.held_by} as it was about to start.")
            return None
        if run.attempt >= MOST_ATTEMPTS:
            self._end(run, State.FAILED, f"Its worker or engine died {run.attempt} times; it is not tried again.")
            return None
        self._move(run, State.RUNNING)
        run.attempt += 1
        run.worker, run.started_at = worker, datetime.now(UTC)
        return run

    def finish(self, run_id: str, outcome: Outcome) -> bool:
        """Store how a run ended. False, and nothing changes, when it had ended already."""
        run = self.runs.locked(run_id)
        if run is None or run.state.ended:
            return False
        summary = _finite(outcome.summary)
        run.trip = summary["trip"]
        run.elapsed_s, run.simulated_s = summary["elapsed_s"], summary["simulated_s"]
        run.floors_peak_mm = summary["floors_peak_mm"]
        run.input_energy_kNm = summary["input_energy_kNm"]
        run.recording_sha256, run.recording_size = outcome.recording_sha256, outcome.recording_size
        run.stations = [RunStation(number=number, **station) for number, station in enumerate(summary["stations"], start=1)]
        state = State(summary["status"])
        self._end(run, state, self._reason(run, state))
        return True

    def fail(self, run_id: str, reason: str) -> None:
        """End a run that could not be executed; an ended run stays as it is."""
        run = self.runs.locked(run_id)
        if run is not None and not run.state.ended:
            self._end(run, State.FAILED, reason)

    def _reason(self, run: Run, state: State) -> str:
        if state is State.CANCELLED:
            return f"Stopped by {run.cancel_requested_by or NOBODY} at {run.simulated_s:.2f} s."
        return run.trip["sentence"] if run.trip else "Ran to its end."

    def _move(self, run: Run, state: State) -> None:
        states.check(run.state, state)
        run.state = state

    def _end(self, run: Run, state: State, reason: str) -> None:
        self._move(run, state)
        run.reason, run.finished_at = reason, datetime.now(UTC)


def worker_alive(seen: datetime | None) -> bool:
    """Whether the worker last seen then is still taken to be alive."""
    return seen is not None and datetime.now(UTC) - seen < WORKER_SILENCE


def _queued(checked: Checked, submitted_by: str) -> Run:
    plan = checked.plan
    return Run(
        id=str(uuid.uuid4()),
        name=plan.name,
        template=plan.template,
        plan=plan.as_dict(),
        digest=plan.digest,
        code_version=__version__,
        seed=plan.seed,
        state=State.QUEUED,
        attempt=0,
        submitted_by=submitted_by,
        submitted_at=datetime.now(UTC),
        duration_s=checked.duration_s,
    )


def _finite(summary: dict[str, Any]) -> dict[str, Any]:
    """The summary with null for what came out as no finite number, which no database's JSON can hold."""
    found: dict[str, Any] = json.loads(json.dumps(summary), parse_constant=lambda _: None)
    return found


def _under(prefix: str, issue: Issue) -> Issue:
    where = ".".join(part for part in (prefix, issue.where) if part)
    return Issue(where, issue.problem, issue.value, issue.fix)
