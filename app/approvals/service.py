"""Rules of approvals: another person approves what was submitted, and exactly that runs. No SQL, no HTTP."""

from __future__ import annotations

from contextlib import suppress

from sqlalchemy.orm import Session

from app.access import Role, SignedIn
from app.approvals.repository import ApprovalRepository
from app.approvals.schemas import ApprovalList, ApprovalOut, Decided
from app.control.service import same_person
from app.jobs.service import named
from app.models import Approval, Run, Sweep
from app.problems import Conflict, NotFound
from app.runs.order import digest_of, is_approved
from app.runs.service import RunService
from app.sweeps.service import SweepService, digest


class NoRight(Exception):
    """A decision by a person who must not decide."""


class ApprovalService:
    """What waits for approval, and the decisions."""

    def __init__(self, session: Session, runs: RunService, sweeps: SweepService):
        self.rows, self.runs, self.sweeps = ApprovalRepository(session), runs, sweeps

    def listed(self, who: SignedIn, by: str) -> ApprovalList:
        """What waits, as the person sees it."""
        shown = []
        for asked in self.rows.waiting():
            with suppress(NotFound):  # one lost row does not hide the others
                found = self._found(asked)
                shown.append(_out(asked, found, _own(asked, found, by), self._refusal(asked, who, by)))
        return ApprovalList(approvals=shown)

    def approve(self, about_id: str, who: SignedIn, by: str, seen: str) -> Decided:
        """Queue what was submitted. `seen` is its digest, as the person saw it.

        Raises NoRight, Conflict where it was decided already or is not what the person saw, NotDriving, and PlanError where
        the rig of a run does not take the plan any more.
        """
        if rig := self.runs.control.rows.rig_of(about_id):
            self.runs.rigs.keep(rig)
        asked = self._asked(about_id, who, by)
        if seen != asked.digest or self._digest(asked) != asked.digest:
            raise Conflict("What waits here is not what you saw: its digest differs. Load the page again and look at the plan.")
        self.rows.decide(asked, "approved", named(by))
        if asked.about == "run":
            run = self.runs.get(about_id)
            self.runs.rigs.check(self.runs.plan_of(run), self.runs.rigs.for_tests(run.rig_id))
            self.runs.control.check([run.rig_id], by)
            self.runs.jobs.approve(about_id, by)
        else:
            self.sweeps.approve(about_id, by)
        return _decided(asked)

    def reject(self, about_id: str, who: SignedIn, by: str, reason: str) -> Decided:
        """End what was submitted, with a reason. Raises NoRight, and Conflict where it was decided already."""
        asked = self._asked(about_id, who, by)
        self.rows.decide(asked, "rejected", named(by), reason)
        if asked.about == "run":
            self.runs.jobs.reject(about_id, by, reason)
        else:
            self.sweeps.reject(about_id, by, reason)
        return _decided(asked)

    def _asked(self, about_id: str, who: SignedIn, by: str) -> Approval:
        """What waits for approval, locked with its run or sweep, if the person may decide."""
        asked = self.runs.control.approval(about_id)
        if asked is not None:
            (self.runs.jobs.rows.locked if asked.about == "run" else self.sweeps.rows.locked_sweep)(about_id)
            asked = self.runs.control.rows.locked_approval(about_id)
        if asked is None:
            raise NotFound(f"No run and no sweep {about_id} asks for approval.")
        if asked.decision is not None:
            raise Conflict(f"It was decided already: {asked.decision} by {asked.decided_by}.")
        if refusal := self._refusal(asked, who, by):
            raise NoRight(refusal)
        return asked

    def _refusal(self, asked: Approval, who: SignedIn, by: str) -> str | None:
        """Why a person can't decide; None where the person can."""
        rules, person = self.runs.control.rules(), by.strip()
        if who.role is not Role.ADMINISTRATOR and not any(same_person(one, person) for one in rules.approvers):
            others = f", and so do {', '.join(rules.approvers)}" if rules.approvers else ""
            return f"Administrators approve{others}. The rules are on the page Settings."
        if _own(asked, self._found(asked), person):
            return "You cannot approve or reject your own submission: withdraw it instead."
        return None

    def _digest(self, asked: Approval) -> str:
        """The digest of what would run now."""
        found = self._found(asked)
        if isinstance(found, Sweep):
            return digest(found)
        return asked.digest if is_approved(found.plan, asked.digest) else digest_of(found.plan)

    def _found(self, asked: Approval) -> Run | Sweep:
        """The run or the sweep that an approval is about."""
        return self.runs.get(asked.about_id) if asked.about == "run" else self.sweeps.get(asked.about_id)


def _out(asked: Approval, found: Run | Sweep, own: bool, refusal: str | None) -> ApprovalOut:
    stored = {name: getattr(asked, name) for name in ("about", "digest", "asked_by", "asked_at")}
    of_run = {name: getattr(found, name, None) for name in ("rig_name", "duration_s", "pace")}
    points = found.points if isinstance(found, Sweep) else None
    name = found.name if isinstance(found, Sweep) else found.plan["name"]  # of what is approved: the run's own may change
    shown = {"id": found.id, "number": found.number, "name": name, "points": points, "own": own, "refusal": refusal}
    return ApprovalOut.model_validate({**stored, **of_run, **shown})


def _own(asked: Approval, found: Run | Sweep, person: str) -> bool:
    """Whether a person submitted what waits, or put it back by undoing its cancel."""
    return any(same_person(one, person) for one in (asked.asked_by, found.submitted_by))


def _decided(asked: Approval) -> Decided:
    shown = {name: getattr(asked, name) for name in ("about", "decision", "decided_by", "decided_at")}
    return Decided.model_validate({**shown, "id": asked.about_id})
