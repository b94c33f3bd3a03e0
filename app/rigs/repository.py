"""SQL of rigs. Never commits."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import locked
from app.jobs.states import State
from app.models import Rig, Run


class RigRepository:
    """SQL of rigs. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def listed(self) -> list[Rig]:
        return list(self.session.scalars(sa.select(Rig).order_by(Rig.number)))

    def get(self, rig_id: str) -> Rig | None:
        return self.session.scalar(sa.select(Rig).where(Rig.id == rig_id))

    def locked(self, rig_id: str) -> Rig | None:
        """The rig as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, Rig, id=rig_id)

    def named(self, name: str) -> Rig | None:
        return self.session.scalar(sa.select(Rig).where(sa.func.lower(Rig.name) == name.lower()))

    def add(self, rig: Rig) -> None:
        self.session.add(rig)
        self.session.flush()

    def remove(self, rig: Rig) -> None:
        self.session.delete(rig)
        self.session.flush()

    def store(self) -> None:
        """Store what was changed."""
        self.session.flush()

    def tests(self, state: State) -> dict[str, int]:
        """Number of tests in a state on each rig."""
        query = sa.select(Run.rig_id, sa.func.count()).where(Run.state == state).group_by(Run.rig_id)
        return {rig: count for rig, count in self.session.execute(query)}

    def used(self, rig_id: str) -> int:
        """Number of runs, ended ones included, that name a rig."""
        return self.session.scalar(sa.select(sa.func.count()).where(Run.rig_id == rig_id)) or 0

    def waiting(self, rig_id: str) -> list[Run]:
        """The queued runs of a rig."""
        return list(self.session.scalars(sa.select(Run).where(Run.state == State.QUEUED, Run.rig_id == rig_id)))
