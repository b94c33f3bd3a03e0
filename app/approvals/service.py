"""Rules of approvals: another person approves what was submitted, and exactly that runs. No SQL, no HTTP."""

from __future__ import annotations

from sqlalchemy.orm import Session

from app.access import Role, SignedIn
from app.approvals.repository import ApprovalRepository
from app.approvals.schemas import ApprovalList, ApprovalOut, Decided
from app.jobs.service import named
from app.models import Approval
from app.problems import Conflict, NotFound
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
        return ApprovalList(approvals=[self._out(one, self._refusal(one, who, by)) for one in self.rows.waiting()])

    def approve(self, about_id: str, who: SignedIn, by: str, seen: str) -> Decided:
        """Queue what was submitted. `seen` is its digest, as the person saw it.

        Raises NoRight, Conflict where it was decided already or is not what the person saw, NotDriving, and PlanError where
        the rig of a run does not take the plan any more.
        """
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
        """What waits for approval, locked, if the person may decide."""
        asked = self.rows.locked(about_id)
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
        if who.role is not Role.ADMINISTRATOR and person not in rules.approvers:
            return "Administrators approve, and the people whom they name on the page Settings."
        return "Nobody approves or rejects the own submission: cancel it instead." if person == asked.asked_by else None

    def _digest(self, asked: Approval) -> str:
        """The digest of what would run now."""
        if asked.about == "run":
            return self.runs.plan_of(self.runs.get(asked.about_id)).digest
        return digest(self.sweeps.get(asked.about_id))

    def _out(self, asked: Approval, refusal: str | None) -> ApprovalOut:
        run = self.runs.get(asked.about_id) if asked.about == "run" else None
        sweep = self.sweeps.get(asked.about_id) if run is None else None
        found = run or sweep
        assert found is not None
        return ApprovalOut.model_validate(
            {
                "about": asked.about,
                "id": asked.about_id,
                "number": found.number,
                "name": found.name,
                "rig_name": run.rig_name if run else None,
                "points": sweep.points if sweep else None,
                "digest": asked.digest,
                "asked_by": asked.asked_by,
                "asked_at": asked.asked_at,
                "refusal": refusal,
            }
        )


def _decided(asked: Approval) -> Decided:
    shown = {name: getattr(asked, name) for name in ("about", "decision", "decided_by", "decided_at")}
    return Decided.model_validate({**shown, "id": asked.about_id})
