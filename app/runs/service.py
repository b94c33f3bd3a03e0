"""Rules of runs: submit, list, cancel, abort and release. No SQL, no HTTP."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from typing import Any

from sqlalchemy.orm import Session

from app.checking import Checked, checked
from app.jobs.hold import Hold
from app.jobs.service import JobService, Queue, named
from app.jobs.states import State
from app.jobs.workers import Workers, alive
from app.models import Run
from app.runs.job import RUNS
from app.runs.order import Outcome
from app.runs.repository import MEASURES, SORTS, Filter, Page, RunRepository
from app.runs.schemas import FromLibrary, QueueOut, RunOut
from rths_engine import __version__
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import MOST_STATIONS, Plan
from rths_engine.planning.reading import read_plan

ABORTED = "running tests aborted"


class RunService:
    """Rules of runs: submit, list, cancel and abort. No SQL, no HTTP."""

    def __init__(self, session: Session, motions: MotionLibrary, queue: Queue | None = None):
        self.runs = RunRepository(session)
        self.jobs: JobService[Run, Outcome] = JobService(session, RUNS, queue)
        self.hold = Hold(session)
        self.session, self.motions = session, motions

    def submit(
        self, plans: Sequence[Any], submitted_by: str, prefix: str = "plans.{}", library: FromLibrary | None = None
    ) -> list[Run]:
        """Check, store and queue all plans. Raises PlanError with every issue, and then stores nothing.

        `library` is the version in the library that the plans were opened from; it is stored with the runs.
        """
        if not plans:
            raise PlanError(Issue("plans", "needs at least one plan", fix="add a plan"))
        if library is not None and not self.runs.has_version(library.id, library.version):
            fix, given = (
                "open the plan in the library again, or leave out 'library'",
                f"{library.id}, version {library.version}",
            )
            raise PlanError(Issue("library", "is not a version of a plan in the library", given, fix))
        issues: list[Issue] = []
        runs: list[Run] = []
        for index, data in enumerate(plans):
            try:
                runs.append(_run_of(checked(data, self.motions)))
            except RthsError as error:
                issues += [_under(prefix.format(index), issue) for issue in error.issues]
        if issues:
            raise PlanError(issues)
        if library is not None:
            for run in runs:
                run.library_id, run.library_version = library.id, library.version
        self.jobs.submit(runs, submitted_by)
        return runs

    def get(self, run_id: str) -> Run:
        """The run with this id. Raises NotFound."""
        return self.jobs.get(run_id)

    def plan_of(self, run: Run) -> Plan:
        return read_plan(run.plan)

    def listed(self, wanted: Filter, page: Page) -> tuple[list[Run], int]:
        self._check_sort(page.sort)
        return self.runs.listed(wanted, page)

    def _check_sort(self, sort: str) -> None:
        """Raise RthsError for a column that does not exist, and for a station that no stored run has."""
        column, colon, station = sort.partition(":")
        if colon and column in MEASURES:
            most = self.runs.most_stations() or MOST_STATIONS
            if not (station.isascii() and station.isdecimal() and 1 <= int(station[:9]) <= most):
                problem = f"needs a station number from 1 to {most} after the colon; no stored run has more stations"
                raise RthsError(Issue("sort", problem, sort, f"try {column}:1"))
        elif sort not in SORTS:
            names = [*SORTS, *(f"{name}:STATION" for name in MEASURES)]
            near = difflib.get_close_matches(sort, names, 1)
            raise RthsError(Issue("sort", "is not a column to sort by", sort, f"try {near[0]}" if near else ", ".join(names)))

    def queue_state(self) -> QueueOut:
        state, seen = self.hold.state, Workers(self.session).last_beat()
        return QueueOut(
            held=state.held,
            held_by=state.held_by,
            held_at=state.held_at,
            held_reason=state.held_reason,
            queued=self.runs.count(State.QUEUED),
            running=[RunOut.of(run) for run in self.runs.in_states(State.RUNNING)],
            worker_seen_at=seen,
            worker_alive=alive(seen),
        )

    def cancel(self, run_id: str, by: str) -> Run:
        """Cancel a queued run now; ask the worker to stop a running run. Raises IllegalTransition for a run that has ended."""
        return self.jobs.cancel(run_id, by)

    def abort(self, by: str) -> list[Run]:
        """Hold the queue and stop every running test. A run that a worker is about to start ends too: the queue is held."""
        self.hold.set(named(by), ABORTED)
        return self.jobs.cancel_running(by)

    def release(self, by: str) -> None:
        self.hold.release(named(by))


def _run_of(checked: Checked) -> Run:
    plan = checked.plan
    return Run(
        name=plan.name,
        template=plan.template,
        plan=plan.as_dict(),
        digest=plan.digest,
        code_version=__version__,
        seed=plan.seed,
        duration_s=checked.duration_s,
    )


def _under(prefix: str, issue: Issue) -> Issue:
    where = ".".join(part for part in (prefix, issue.where) if part)
    return Issue(where, issue.problem, issue.value, issue.fix)
