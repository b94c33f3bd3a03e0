"""Rules of the control of rigs: one person drives a rig. No SQL, no HTTP.

The rule is off until the laboratory switches it on. Then only the driver of a rig submits to it, cancels and retries its tests.
The queue is one for all rigs: the driver of any rig concerned holds it, because a hold only stops; the driver of all rigs whose
tests would start releases it. Abort needs no control, ever.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from datetime import timedelta
from functools import partial

from sqlalchemy.orm import Session

from app.control.repository import ControlRepository
from app.control.schemas import ControlList, ControlOut, RulesIn
from app.jobs.service import named
from app.jobs.states import State
from app.models import Approval, RigControl
from app.models.accounts import key_of
from app.problems import Conflict, NotFound
from rths_engine.foundation.errors import Issue, PlanError, RthsError

EXPIRES = timedelta(minutes=10)  # after the last renewal; an open page of the driver renews every minute


class NotDriving(Conflict):
    """A change that needs the control of a rig which the person does not have."""


class NotYours(Conflict):
    """The withdrawal of a submission by a person who did not submit it."""


class Control:
    """Who drives which rig."""

    def __init__(self, session: Session):
        self.rows = ControlRepository(session)

    def rules(self) -> RulesIn:
        return RulesIn.model_validate(self.rows.rules)

    def save_rules(self, given: RulesIn, accounts: bool) -> RulesIn:
        """Set all rules. With `accounts`, raises PlanError for every approver who is not an account that may operate."""
        approvers: list[str] = []
        issues: list[Issue] = []
        for index, name in enumerate(given.approvers):
            try:
                approvers.append(self._known(name, f"approvers.{index}", accounts))
            except RthsError as error:
                issues += error.issues
        if issues:
            raise PlanError(issues)
        for name, value in {**given.model_dump(), "approvers": list(dict.fromkeys(approvers))}.items():
            setattr(self.rows.rules, name, value)
        return self.rules()

    def shown(self, by: str, may_take_over: bool) -> ControlList:
        """Who drives each rig, as the person `by` sees it."""
        driven = self._driven_now()
        rigs = [_out(rig.id, rig.name, driven.get(rig.id), by) for rig in self.rows.rigs()]
        refused = {one.rig_id: _said(partial(self.check, [one.rig_id]), by) for one in rigs}
        return ControlList(
            one_driver=self.rows.rules.one_driver,
            approvals=self.approvals,
            may_take_over=may_take_over,
            refusals={rig: why for rig, why in refused.items() if why},
            hold_refusal=_said(self.check_hold, by),
            release_refusal=_said(self.check_release, by),
            rigs=rigs,
        )

    def take(self, rig_id: str, by: str) -> ControlOut:
        """Take the control of a rig that nobody else drives. Raises NotDriving."""
        name, held = self._locked(rig_id)
        if held and held.driver != _person(by):
            raise NotDriving(_refusal(rig_id, name, held))
        return self._give(rig_id, name, by, held)

    def renew(self, rig_id: str, by: str) -> ControlOut:
        """Keep the control for a further time. Raises NotDriving for a person who does not drive the rig."""
        name, held = self._driven(rig_id, by)
        held.until = self.rows.now() + EXPIRES
        return _out(rig_id, name, held, by)

    def release(self, rig_id: str, by: str) -> ControlOut:
        """Give the control back: nobody drives the rig. Raises NotDriving."""
        name, held = self._driven(rig_id, by)
        held.driver, held.until, held.asked_by = "", self.rows.now(), ""
        return _out(rig_id, name, None, by)

    def ask(self, rig_id: str, by: str) -> ControlOut:
        """Ask who drives a rig for its control: the pages of the driver show it. Raises Conflict where nobody drives it."""
        name, held = self._locked(rig_id)
        if held is None:
            raise Conflict(f"Nobody drives {name}. Take its control instead.")
        if held.driver == _person(by):
            raise Conflict(f"You drive {name} already.")
        held.asked_by = _person(by)
        return _out(rig_id, name, held, by)

    def hand_over(self, rig_id: str, by: str, to: str, accounts: bool) -> ControlOut:
        """Give the control to another person. Raises NotDriving, and with `accounts` RthsError where nobody has this name."""
        name, held = self._driven(rig_id, by)
        return self._give(rig_id, name, self._known(to, "to", accounts), held, by)

    def take_over(self, rig_id: str, by: str) -> ControlOut:
        """Take the control from whoever has it. The caller has checked that the person is an administrator."""
        name, held = self._locked(rig_id)
        return self._give(rig_id, name, by, held)

    @property
    def approvals(self) -> bool:
        """Whether submissions wait until another person approves them."""
        return self.rows.rules.approvals

    def ask_approval(self, about: str, about_id: str, digest: str, by: str) -> None:
        """Ask for the approval of a run or a sweep."""
        at = self.rows.now()
        self.rows.ask(Approval(about=about, about_id=about_id, digest=digest, asked_by=named(by), asked_at=at))

    def approval(self, about_id: str) -> Approval | None:
        """The latest approval of a run or a sweep; None where none was asked for."""
        return self.rows.approval(about_id)

    def withdraw(self, about_id: str, submitted_by: str, by: str) -> bool:
        """Close an approval that waits, because its run or sweep is cancelled. False where it does not wait any more.

        The caller has locked the run or the sweep.
        Raises NotYours for a person who neither submitted it nor asked for its approval: who approves rejects it instead.
        """
        asked = self.rows.locked_approval(about_id)
        if asked is None or asked.decision is not None:
            return False
        if not any(same_person(one, by) for one in (submitted_by, asked.asked_by)):
            raise NotYours(f"It waits for approval, and only {asked.asked_by} withdraws it. An approver rejects it instead.")
        asked.decision, asked.decided_by, asked.decided_at = "withdrawn", named(by), self.rows.now()
        return True

    def check(self, rigs: Iterable[str], by: str) -> None:
        """Raise NotDriving unless the person drives all these rigs, or the laboratory has no such rule."""
        for rig_id in dict.fromkeys(rigs) if self.rows.rules.one_driver else ():
            held = self._valid(self.rows.get(rig_id))
            if held is None or held.driver != by.strip():
                raise NotDriving(_refusal(rig_id, self.rows.named(rig_id) or rig_id, held))

    def check_run(self, run_id: str, by: str) -> None:
        """Raise NotDriving unless the person may drive the rig of a run."""
        rig_id = self.rows.rig_of(run_id)
        if rig_id is not None:
            self.check([rig_id], by)

    def check_hold(self, by: str) -> None:
        """Raise NotDriving unless the person drives one of the rigs that have tests or a driver."""
        if not self.rows.rules.one_driver:
            return
        driven = self._driven_now()
        concerned = [*driven, *self.rows.with_tests(State.QUEUED, State.RUNNING)]
        if concerned and not any(one.driver == by.strip() for one in driven.values()):
            self.check(concerned[:1], by)

    def check_release(self, by: str) -> None:
        """Raise NotDriving unless the person drives every rig whose tests wait."""
        self.check(self.rows.with_tests(State.QUEUED), by)

    def _known(self, name: str, where: str, accounts: bool) -> str:
        """The name as its account has it; with `accounts`, raises RthsError where no account that may operate has it."""
        account = self.rows.operator(name)
        if account is not None:
            return account.name
        if accounts:
            fix = "give the name of an account that is not disabled and has at least the role operator"
            raise RthsError(Issue(where, "is not a person who may operate", name, fix))
        return name.strip()

    def _locked(self, rig_id: str) -> tuple[str, RigControl | None]:
        """The name of a rig and its control if it is valid, locked. Raises NotFound."""
        name = self.rows.named(rig_id)
        if name is None:
            raise NotFound(f"There is no rig {rig_id}.")
        return name, self._valid(self.rows.locked(rig_id))

    def _driven_now(self) -> dict[str, RigControl]:
        """The rigs that somebody drives, each with its control."""
        now = self.rows.now()
        timely = {rig: one for rig, one in self.rows.controls().items() if one.driver and one.until > now}
        lost = self.rows.may_not_operate(one.driver for one in timely.values())
        return {rig: one for rig, one in timely.items() if one.driver not in lost}

    def _valid(self, control: RigControl | None) -> RigControl | None:
        """The control if its driver has it still: it ends with its time, and with the right of the driver's account."""
        if control is None or not control.driver or control.until <= self.rows.now():
            return None
        return None if self.rows.may_not_operate([control.driver]) else control

    def _driven(self, rig_id: str, by: str) -> tuple[str, RigControl]:
        name, held = self._locked(rig_id)
        if held is None or held.driver != _person(by):
            raise NotDriving(_refusal(rig_id, name, held))
        return name, held

    def _give(self, rig_id: str, name: str, to: str, held: RigControl | None, seen_by: str | None = None) -> ControlOut:
        now = self.rows.now()
        row = held or self.rows.get(rig_id)
        if row is None:
            row = RigControl(rig_id=rig_id)
            self.rows.add(row)
        if held is None or held.driver != _person(to):
            row.since = now
        row.driver, row.until, row.asked_by = _person(to), now + EXPIRES, ""
        return _out(rig_id, name, row, to if seen_by is None else seen_by)


def _said(check: Callable[[str], None], by: str) -> str | None:
    """Why a check refuses a person; None where it passes."""
    try:
        check(by)
    except NotDriving as refused:
        return str(refused)
    return None


def same_person(first: str, second: str) -> bool:
    """Whether two names are those of one account, in any case of their letters; all who give no name are one."""
    return key_of(named(first)) == key_of(named(second))


def _person(by: str) -> str:
    if not by.strip():
        raise RthsError(Issue("by", "is blank", by, "give the name of the person who drives: at the top of the page New test"))
    return by.strip()


def _out(rig_id: str, name: str, held: RigControl | None, by: str) -> ControlOut:
    return ControlOut(
        rig_id=rig_id,
        rig_name=name,
        driver=held.driver if held else None,
        since=held.since if held else None,
        until=held.until if held else None,
        asked_by=(held.asked_by or None) if held else None,
        yours=held is not None and held.driver == by.strip(),
        sentence=_sentence(name, held),
    )


def _sentence(name: str, held: RigControl | None) -> str:
    return f"{held.driver} drives {name}." if held else f"Nobody drives {name}."


def _refusal(rig_id: str, name: str, held: RigControl | None) -> str:
    where = f"on the page Queue, or by POST /api/v1/control/{rig_id}"
    if held is None:
        return f"Nobody drives {name}, and one person must. Take its control {where}/take, then try again."
    until = f"{held.until:%H:%M} UTC"
    return f"{held.driver} drives {name} until {until} or longer. Ask {held.driver} for the control {where}/request."
