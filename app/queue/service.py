"""Rules of the queue of tests: its order, hold, abort and release, and what people see of it. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Sequence

from sqlalchemy.orm import Session

from app.control.service import Control, NotDriving, NotYours
from app.db import afterwards
from app.jobs.aborts import ABORTED, Aborts
from app.jobs.hold import Hold
from app.jobs.service import JobService, named
from app.jobs.states import State
from app.jobs.tables import QueueState
from app.latch import Latch
from app.models import Run
from app.problems import Conflict, NotFound
from app.queue.outlook import outlook
from app.queue.placing import moved
from app.queue.repository import QueueRepository, Waiting
from app.queue.schemas import CancelledOut, Move, QueueOut, Refusal
from app.runs.job import RUNS
from app.runs.order import Outcome
from rths_engine.foundation.errors import Issue, RthsError


class QueueService:
    """Rules of the queue of tests. No SQL, no HTTP."""

    def __init__(self, session: Session, latch: Latch | None = None):
        self.session, self.rows, self.hold = session, QueueRepository(session), Hold(session)
        self.latch = latch or Latch()
        self._released: list[str] = []
        self.jobs: JobService[Run, Outcome] = JobService(session, RUNS)
        self.control = Control(session)

    def state(self, limit: int = 200) -> QueueOut:
        """The queue with its first `limit` waiting tests."""
        return outlook(self.session, self.rows, self._held(), limit)

    def move(self, asked: Move) -> None:
        """Move queued runs as a block, in the order given.

        Raises Conflict for a run that does not wait any more, and NotDriving for a run whose rig somebody else drives.
        """
        given = [name for name in ("before", "after", "to") if getattr(asked, name) is not None]
        if len(given) != 1:
            fix = "give one of 'before', 'after' and 'to'"
            raise RthsError(Issue("", "needs one new place", ", ".join(given) or None, fix))
        self.hold.locked()
        line = self.rows.waiting()
        runs = list(dict.fromkeys(asked.runs))
        self._check_waiting(runs, line)
        self._check_driving(runs, line, asked.by)
        others = [one for one in line if one.id not in set(runs)]
        index = 0 if asked.to == "top" else len(others)
        if anchor := asked.before or asked.after:
            places = {one.id: place for place, one in enumerate(others)}
            if anchor in runs:
                raise RthsError(Issue(given[0], "needs a run that is not moved itself", anchor))
            self._check_waiting([anchor], others)
            index = places[anchor] + (asked.after is not None)
        beside = others[max(0, index - 1 if asked.after or asked.to == "bottom" else index)] if others else line[0]
        self.rows.place(moved(line, runs, index, beside.priority, self.rows.last_number()))

    def prioritise(self, runs: Sequence[str], priority: int, by: str) -> None:
        """Give queued runs a priority. Raises Conflict for a run that does not wait any more, and NotDriving as `move`."""
        self.hold.locked()
        line = self.rows.waiting()
        self._check_waiting(runs, line)
        self._check_driving(runs, line, by)
        self.rows.prioritise(runs, priority)

    def cancel(self, runs: Sequence[str], by: str) -> CancelledOut:
        """Cancel queued and running runs. Others are left as they are, each with its reason."""
        self.hold.locked()  # first, as at a start: two requests that lock runs in opposite orders would block each other
        cancelled, refused = [], []
        for run in dict.fromkeys(runs):
            try:
                self._cancel(run, by)
                cancelled.append(run)
            except (NotFound, Conflict) as error:
                refused.append(Refusal(id=run, reason=str(error)))
        return CancelledOut(cancelled=cancelled, refused=refused)

    def _cancel(self, run_id: str, by: str) -> None:
        """Cancel one run. Raises NotFound, and Conflict where it has ended or the person may not cancel it."""
        run = self.jobs.locked(run_id)
        if run.state.ended:
            raise Conflict(f"Run {run.number} has already ended: it is {run.state}.")
        try:
            if run.state is not State.TO_APPROVE or not self.control.withdraw(run_id, run.submitted_by, by):
                self.control.check([run.rig_id], by)
        except (NotDriving, NotYours) as error:
            raise Conflict(f"Run {run.number}: {error}") from None
        self.jobs.cancel(run_id, by)

    def hold_it(self, by: str, reason: str) -> None:
        """Hold the queue: no queued test starts; running tests go on."""
        self.control.check_hold(by)
        self.hold.set(named(by), reason.strip())

    def release(self, by: str) -> None:
        """Release the queue, and the latch of every service and worker once that is stored."""
        self.control.check_release(by)
        self.hold.locked()
        self._released = released = Aborts(self.session).release(self.latch.presses, by)
        self.hold.release(named(by))
        afterwards(self.session, "after_commit", lambda: self.latch.merge([], released))

    def _held(self) -> QueueState:
        """The hold; that of a press of Abort which the database does not know yet too."""
        stored, pressed = self.hold.state, [one for one in self.latch.presses if one.id not in self._released]
        if stored.held or not pressed:
            return stored
        first = pressed[0]
        return QueueState(id=1, held=True, held_by=named(first.by), held_at=first.time, held_reason=ABORTED)

    def _check_driving(self, runs: Sequence[str], line: Sequence[Waiting], by: str) -> None:
        """Raise NotDriving unless the person drives the rigs of all these runs: the order decides what moves a rig next."""
        self.control.check([one.rig_id for one in line if one.id in set(runs)], by)

    def _check_waiting(self, runs: Sequence[str], line: Sequence[Waiting]) -> None:
        waiting = {one.id for one in line}
        for run in runs:
            if run not in waiting:
                job = self.jobs.get(run)
                raise Conflict(f"Run {job.number}, {job.name}, does not wait in the queue any more: it is {job.state}.")
