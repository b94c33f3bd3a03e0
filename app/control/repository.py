"""SQL of the control of rigs and of the rules of the laboratory. Never commits."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import lock, now
from app.jobs.states import State
from app.models import Account, Approval, Rig, RigControl, Rules, Run
from app.models.accounts import key_of
from app.roles import Role

_ABLE = sa.and_(Account.disabled_at.is_(None), Account.role != Role.VIEWER.name.lower())


class ControlRepository:
    """SQL of the control of rigs. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    @property
    def rules(self) -> Rules:
        return self.session.get_one(Rules, 1)

    def now(self) -> datetime:
        """The time by the clock of the database."""
        return now(self.session)

    def rigs(self) -> list[Rig]:
        """The rigs that take tests."""
        return list(self.session.scalars(sa.select(Rig).where(Rig.retired.is_(False)).order_by(Rig.number)))

    def named(self, rig_id: str) -> str | None:
        """The name of a rig; None where there is none with this id."""
        return self.session.scalar(sa.select(Rig.name).where(Rig.id == rig_id))

    def controls(self) -> dict[str, RigControl]:
        """The rows of all rigs that somebody drove, by rig."""
        return {one.rig_id: one for one in self.session.scalars(sa.select(RigControl))}

    def get(self, rig_id: str) -> RigControl | None:
        return self.session.get(RigControl, rig_id)

    def locked(self, rig_id: str) -> RigControl | None:
        """The row of a rig, locked against other writers until the end of the transaction by the row of the rig itself."""
        lock(self.session, Rig.retired, Rig.id == rig_id)
        found = sa.select(RigControl).where(RigControl.rig_id == rig_id).execution_options(populate_existing=True)
        return self.session.scalar(found)

    def add(self, control: RigControl) -> None:
        self.session.add(control)

    def approval(self, about_id: str) -> Approval | None:
        """The latest approval of a run or a sweep; None where none was asked for."""
        query = sa.select(Approval).where(Approval.about_id == about_id).order_by(Approval.number.desc()).limit(1)
        return self.session.scalar(query)

    def locked_approval(self, about_id: str) -> Approval | None:
        """The latest approval of a run or a sweep, locked against other writers until the end of the transaction.

        The caller has locked the run or the sweep: all lock in this order, so that no two wait for each other.
        """
        lock(self.session, Approval.reason, Approval.about_id == about_id)
        query = sa.select(Approval).where(Approval.about_id == about_id).order_by(Approval.number.desc()).limit(1)
        return self.session.scalar(query.execution_options(populate_existing=True))

    def ask(self, approval: Approval) -> None:
        self.session.add(approval)

    def operator(self, name: str) -> Account | None:
        """The account with this name, in any case of its letters, where it may operate; None otherwise."""
        return self.session.scalar(sa.select(Account).where(Account.key == key_of(name), _ABLE))

    def may_not_operate(self, names: Iterable[str]) -> set[str]:
        """Those of these names whose accounts are disabled or may not operate any more. A name without account stays."""
        keys = {key_of(name): name for name in names if name}
        lost = sa.select(Account.key).where(Account.key.in_(keys), ~_ABLE) if keys else None
        return set() if lost is None else {keys[key] for key in self.session.scalars(lost)}

    def rig_of(self, run_id: str) -> str | None:
        return self.session.scalar(sa.select(Run.rig_id).where(Run.id == run_id))

    def with_tests(self, *states: State) -> list[str]:
        """The rigs with tests in these states."""
        return list(self.session.scalars(sa.select(Run.rig_id).where(Run.state.in_(states)).distinct()))
