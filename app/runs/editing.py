"""Rules of what people say about runs: name, tags, notes, archive, delete and restore. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import UTC, datetime, timedelta
from functools import partial

from sqlalchemy.orm import Session

from app.db import afterwards
from app.jobs.states import State
from app.models import Run
from app.problems import Conflict, NotFound
from app.runs.edit_rows import EditRows
from app.runs.table_schemas import LONGEST_TAG, MOST_TAGS, Action, BulkResult, Refusal, RunChange
from app.store.base import Store
from app.store.filed import of_run
from rths_engine.foundation.errors import Issue, RthsError

GRACE = timedelta(days=7)  # from the deletion of a run to the removal of its row and its recording
PURGED = 200  # runs removed at once


class RunEditing:
    """Changes of what people say about runs. Plan, digest and results of a run never change."""

    def __init__(self, session: Session):
        self.rows, self.session = EditRows(session), session

    def change(self, run_id: str, change: RunChange) -> Run:
        """Change name, tags, notes or shelf of a run.

        Raises NotFound, and Conflict for a shelf before the end of the run, or for anything while it waits for approval.
        """
        run = self._locked(run_id)
        _check_decided(run)
        if change.name is not None:
            run.name = change.name
        if change.tags is not None:
            run.tags = list(dict.fromkeys(change.tags))
        if change.notes is not None:
            run.notes = change.notes
        if change.archived is not None:
            _shelve(run, change.archived)
        return run

    def delete(self, run_id: str) -> Run:
        """Hide a run and remove it after GRACE. Raises Conflict where it has not ended, or where a diagnosis uses it."""
        run = self._locked(run_id)
        self._delete(run)
        return run

    def restore(self, run_id: str) -> Run:
        """Show a deleted run again, with all that it had."""
        run = self._locked(run_id)
        run.deleted_at = None
        return run

    def bulk(self, action: Action, ids: Sequence[str], tags: Sequence[str]) -> BulkResult:
        """Do one action on several runs. A run for which it is not allowed stays and is reported with the reason."""
        if action in ("tag", "untag") and not tags:
            raise RthsError(Issue("tags", f"needs at least one tag for the action {action}", fix="add a tag"))
        actions: dict[str, Callable[[Run], None]] = {
            "tag": lambda run: _tag(run, tags),
            "untag": lambda run: _untag(run, tags),
            "archive": lambda run: _shelve(run, True),
            "unarchive": lambda run: _shelve(run, False),
            "delete": self._delete,
            "restore": lambda run: setattr(run, "deleted_at", None),
        }
        found, changed, refused = self.rows.locked(ids), [], []
        for run_id in dict.fromkeys(ids):
            try:
                if run_id not in found:
                    raise NotFound(f"There is no run {run_id}.")
                actions[action](found[run_id])
                changed.append(run_id)
            except (Conflict, NotFound) as error:
                refused.append(Refusal(id=run_id, reason=str(error)))
        return BulkResult(changed=changed, refused=refused)

    def tags(self) -> list[str]:
        """Every tag that a run has."""
        return self.rows.tags()

    def purge(self, store: Store, now: datetime | None = None) -> int:
        """Remove the runs that were deleted before GRACE, and their recordings after the commit. Returns their number."""
        removed = 0
        for run in self.rows.deleted_before((now or datetime.now(UTC)) - GRACE, PURGED):
            if self.rows.remove(run):
                afterwards(self.session, "after_commit", partial(store.discard, of_run(run.id)))
                removed += 1
        return removed

    def _locked(self, run_id: str) -> Run:
        """The run as it is now, locked, so that what allows the change still holds when it is stored. Raises NotFound."""
        run = self.rows.locked([run_id]).get(run_id)
        if run is None:
            raise NotFound(f"There is no run {run_id}.")
        return run

    def _delete(self, run: Run) -> None:
        _check_ended(run, "deleted")
        diagnosis = self.rows.diagnosis_of(run)
        if diagnosis is not None:
            fix = "Delete the diagnosis first, or archive the run."
            raise Conflict(f"Run #{run.number} is used by diagnosis {diagnosis.number}, {diagnosis.name}. {fix}")
        run.deleted_at = run.deleted_at or datetime.now(UTC)


def _check_ended(run: Run, become: str) -> None:
    if not run.state.ended:
        raise Conflict(f"Run #{run.number} has not ended: it is {run.state}. It can be {become} after its end.")


def _shelve(run: Run, archived: bool) -> None:
    if archived:
        _check_ended(run, "archived")
    run.archived = archived


def _check_decided(run: Run) -> None:
    if run.state is State.TO_APPROVE:
        why = "who approves it must find it as it was submitted"
        raise Conflict(f"Run #{run.number} waits for approval: {why}. Change it afterwards, or withdraw it.")


def _tag(run: Run, tags: Sequence[str]) -> None:
    _check_decided(run)
    found = list(dict.fromkeys([*run.tags, *tags]))
    if len(found) > MOST_TAGS:
        raise Conflict(f"Run #{run.number} would have {len(found)} tags; the limit is {MOST_TAGS} of {LONGEST_TAG} characters.")
    run.tags = found


def _untag(run: Run, tags: Sequence[str]) -> None:
    _check_decided(run)
    run.tags = [tag for tag in run.tags if tag not in tags]
