"""Rules of runs: submit, list, cancel and retry. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import Any

from sqlalchemy.orm import Session

from app.calculations.answer import HERE, Calculate
from app.checking import Outline, outlines
from app.control.service import Control
from app.jobs.service import UNDO, JobService, Queue, undoable
from app.jobs.states import State
from app.models import EMULATED, Rig, Run
from app.problems import Conflict
from app.rigs.service import RigService
from app.runs.from_library import check_as_kept
from app.runs.job import RUNS
from app.runs.order import Outcome, digest_of
from app.runs.repository import Filter, Page, RunRepository
from app.runs.schemas import FromLibrary
from rths_engine import __version__
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan


class RunService:
    """Rules of runs: submit, list, cancel and retry. No SQL, no HTTP."""

    def __init__(self, session: Session, motions: MotionLibrary, queue: Queue | None = None, calculate: Calculate = HERE):
        self.runs = RunRepository(session)
        self.jobs: JobService[Run, Outcome] = JobService(session, RUNS, queue)
        self.rigs, self.control = RigService(session), Control(session)
        self.session, self.motions, self.calculate = session, motions, calculate

    def submit(
        self,
        plans: Sequence[Any],
        submitted_by: str,
        prefix: str = "plans.{}",
        library: FromLibrary | None = None,
        rig: str = EMULATED,
        priority: int = 0,
        as_kept: bool = False,
    ) -> list[Run]:
        """Check, store and queue all plans. Raises PlanError with every issue, and then stores nothing.

        `library` is the version in the library that the plans were opened from; it is stored with the runs. With `as_kept`
        the plans must be that version: raises Forbidden otherwise.
        """
        if not plans:
            raise PlanError(Issue("plans", "needs at least one plan", fix="add a plan"))
        outlined = outlines(self.calculate, plans, self.motions)  # before the database is asked for anything
        kept = self.runs.version(library.id, library.version) if library else None
        if library is not None and kept is None:
            fix, given = (
                "open the plan in the library again, or leave out 'library'",
                f"{library.id}, version {library.version}",
            )
            raise PlanError(Issue("library", "is not a version of a plan in the library", given, fix))
        self.rigs.keep(rig)
        on = self.rigs.for_tests(rig)
        to_approve = self.control.approvals
        if not to_approve:
            self.control.check([on.id], submitted_by)
        issues: list[Issue] = []
        runs: list[Run] = []
        for index, found in enumerate(outlined):
            try:
                if isinstance(found, RthsError):
                    raise found
                self.rigs.check(found.plan, on)
                runs.append(_run_of(found, on, priority))
            except RthsError as error:
                issues += [_under(prefix.format(index), issue) for issue in error.issues]
        if issues:
            raise PlanError(issues)
        if as_kept:
            check_as_kept(runs, kept, self.motions)
        if library is not None:
            for run in runs:
                run.library_id, run.library_version = library.id, library.version
        self.jobs.submit(runs, submitted_by, State.TO_APPROVE if to_approve else State.QUEUED)
        for run in runs if to_approve else ():
            self.control.ask_approval("run", run.id, digest_of(run.plan), run.submitted_by)
        return runs

    def get(self, run_id: str) -> Run:
        """The run with this id. Raises NotFound."""
        return self.jobs.get(run_id)

    def plan_of(self, run: Run) -> Plan:
        return read_plan(run.plan)

    def listed(self, wanted: Filter, page: Page) -> tuple[list[Run], int]:
        return self.runs.listed(wanted, page)

    def cancel(self, run_id: str, by: str) -> Run:
        """Cancel a queued run now; ask the worker to stop a running run. Raises IllegalTransition for a run that has ended."""
        run = self.jobs.locked(run_id)
        if run.state is not State.TO_APPROVE or not self.control.withdraw(run_id, run.submitted_by, by):
            self.control.check([run.rig_id], by)
        return self.jobs.cancel(run_id, by)

    def undo_cancel(self, run_id: str, by: str) -> Run:
        """Put a run back at its place in the queue that was cancelled there. Raises Conflict for any other run.

        Its rig is checked as for a new run: meanwhile it may have been retired, or its capacities lowered. A run that nobody
        approved waits for approval, where the laboratory has this rule: under the name of its plan, which is approved.
        """
        self.rigs.keep(self.get(run_id).rig_id)
        run = self.jobs.locked(run_id)
        if run.deleted_at is not None or run.archived:
            shelf = "deleted" if run.deleted_at is not None else "archived"
            raise Conflict(f"Run {run.number} is {shelf}. Restore it first, then undo the cancel.")
        asked = self.control.approval(run_id)
        if asked is not None and asked.decision == "rejected":
            raise Conflict(f"Run {run.number} was rejected by {asked.decided_by}. Change its plan, or retry it to ask anew.")
        to_approve = self.control.approvals and (asked is None or asked.decision != "approved")
        if not to_approve:
            self.control.check([run.rig_id], by)
        if run.state is State.CANCELLED:
            self.rigs.check(self.plan_of(run), self.rigs.for_tests(run.rig_id))
            if to_approve:
                run.name = run.plan["name"]
        back = self.jobs.undo_cancel(run_id, by, State.TO_APPROVE if to_approve else State.QUEUED)
        if to_approve:
            self.control.ask_approval("run", run_id, digest_of(run.plan), by)
        return back

    def undo_until(self, run: Run) -> datetime | None:
        """Until when the cancel of a run can be undone; None where it can't."""
        if run.finished_at is None or not undoable(run) or run.deleted_at is not None or run.archived:
            return None
        asked = self.control.approval(run.id)
        return None if asked is not None and asked.decision == "rejected" else run.finished_at + UNDO

    def retry(self, run_id: str, by: str) -> Run:
        """Queue the plan of a run that has ended again, on the same rig. Raises Conflict for a run that has not ended.

        It takes the name that people gave the run; where it waits for approval, that of the plan, which is approved.
        """
        first = _ended(self.get(run_id))
        (run,) = self.submit([first.plan], by, prefix="plan", rig=first.rig_id, priority=first.priority)
        first = _ended(self.jobs.locked(run_id))  # the check of the plan takes a while, in which others may change the run
        if run.state is not State.TO_APPROVE:
            run.name = first.name
        run.retry_of = first.retry_of or first.id
        run.library_id, run.library_version = first.library_id, first.library_version
        return run


def _ended(run: Run) -> Run:
    if not run.state.ended:
        raise Conflict(f"Run {run.number} has not ended: it is {run.state}. Only a run that has ended can be retried.")
    return run


def _run_of(checked: Outline, rig: Rig, priority: int) -> Run:
    plan = checked.plan
    return Run(
        name=plan.name,
        template=plan.template,
        plan=plan.as_dict(),
        digest=plan.digest,
        code_version=__version__,
        seed=plan.seed,
        duration_s=checked.duration_s,
        priority=priority,
        pace=plan.pace.factor if plan.pace.kind == "real_time" else None,
        samples=checked.steps * plan.substeps,
        size=f"{plan.test}, {checked.floors} modes, {len(plan.stations)} stations",
    ).on(rig)


def _under(prefix: str, issue: Issue) -> Issue:
    where = ".".join(part for part in (prefix, issue.where) if part)
    return Issue(where, issue.problem, issue.value, issue.fix)
