"""SQL of sweeps, their shards and their results. Never commits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session, undefer

from app.db import locked
from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.models import Sweep, SweepPart, SweepShard

COUNTED = ("count", "tripped", "invalid", "failed", "elapsed_s", "simulated_s")
RECENT = 50  # parts from which the speed of the machine is estimated


@dataclass(frozen=True, slots=True)
class Standing:
    """How far a sweep is: shards in each state, points done and how they ended, times (s), first start and last end.

    `unverified` counts the points whose results have no checksum.
    """

    states: dict[State, int]
    done: int = 0
    tripped: int = 0
    invalid: int = 0
    failed: int = 0
    elapsed_s: float = 0.0
    simulated_s: float = 0.0
    unverified: int = 0
    started_at: datetime | None = None
    finished_at: datetime | None = None
    reason: str | None = None


class SweepRepository(JobRepository[SweepShard]):
    """SQL of sweeps. Never commits."""

    def __init__(self, session: Session):
        super().__init__(session, SweepShard)

    def add_sweep(self, sweep: Sweep) -> None:
        self.session.add(sweep)
        self.session.flush()

    def sweep(self, sweep_id: str) -> Sweep | None:
        return self.session.scalar(sa.select(Sweep).where(Sweep.id == sweep_id))

    def locked_sweep(self, sweep_id: str) -> Sweep | None:
        """The sweep as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, Sweep, id=sweep_id)

    def listed(self, limit: int, offset: int) -> tuple[list[Sweep], int]:
        total = self.session.scalar(sa.select(sa.func.count()).select_from(Sweep)) or 0
        query = sa.select(Sweep).order_by(Sweep.number.desc()).limit(limit).offset(offset)
        return list(self.session.scalars(query)), total

    def standings(self, numbers: Sequence[int]) -> dict[int, Standing]:
        """The standing of each sweep."""
        found: dict[int, dict[str, Any]] = {number: {"states": {}} for number in numbers}
        for number, state, count, started, finished in self.session.execute(
            sa.select(
                SweepShard.sweep_number,
                SweepShard.state,
                sa.func.count(),
                sa.func.min(SweepShard.started_at),
                sa.func.max(SweepShard.finished_at),
            )
            .where(SweepShard.sweep_number.in_(numbers))
            .group_by(SweepShard.sweep_number, SweepShard.state)
        ):
            one = found[number]
            one["states"][state] = count
            one["started_at"] = min(filter(None, (one.get("started_at"), started)), default=None)
            one["finished_at"] = max(filter(None, (one.get("finished_at"), finished)), default=None)
        unverified = sa.case((SweepPart.sha256.is_(None), SweepPart.count), else_=0)
        sums = [sa.func.sum(one) for one in (*(getattr(SweepPart, name) for name in COUNTED), unverified)]
        for number, *values in self.session.execute(
            sa.select(SweepPart.sweep_number, *sums).where(SweepPart.sweep_number.in_(numbers)).group_by(SweepPart.sweep_number)
        ):
            found[number] |= dict(zip(("done", *COUNTED[1:], "unverified"), values, strict=True))
        for number, reason in self.session.execute(
            sa.select(SweepShard.sweep_number, sa.func.min(SweepShard.reason))
            .where(SweepShard.sweep_number.in_(numbers), SweepShard.state == State.FAILED)
            .group_by(SweepShard.sweep_number)
        ):
            found[number]["reason"] = reason
        return {number: Standing(**one) for number, one in found.items()}

    def unfinished(self, sweep: Sweep) -> list[str]:
        """The ids of the shards that wait or run, oldest first."""
        query = sa.select(SweepShard.id).where(
            SweepShard.sweep_number == sweep.number, SweepShard.state.in_((State.QUEUED, State.RUNNING))
        )
        return list(self.session.scalars(query.order_by(SweepShard.number)))

    def spans(self, sweep_number: int, first: int, end: int) -> list[tuple[int, int]]:
        """The spans (first, end) of points that have results, in order, among the points from `first` to before `end`."""
        query = sa.select(SweepPart.first, SweepPart.count).where(
            SweepPart.sweep_number == sweep_number, SweepPart.first >= first, SweepPart.first < end
        )
        return [(start, start + count) for start, count in self.session.execute(query.order_by(SweepPart.first))]

    def add_part(self, part: SweepPart) -> None:
        self.session.add(part)
        self.session.flush()

    def parts(self, sweep: Sweep, first: int = 0, end: int | None = None) -> list[SweepPart]:
        """The parts that begin among the points from `first` to before `end`, with values and reasons, in order."""
        query = sa.select(SweepPart).where(SweepPart.sweep_number == sweep.number, SweepPart.first >= first)
        if end is not None:
            query = query.where(SweepPart.first < end)
        query = query.order_by(SweepPart.first).options(undefer(SweepPart.values), undefer(SweepPart.reasons))
        return list(self.session.scalars(query))

    def speed(self, cost: str) -> tuple[float, float, int]:
        """Computing time and simulated time (s), and number of points, of the newest parts of sweeps with this `cost`."""
        newest = (
            sa.select(SweepPart.elapsed_s, SweepPart.simulated_s, SweepPart.count)
            .join(Sweep, Sweep.number == SweepPart.sweep_number)
            .where(Sweep.cost == cost)
            .order_by(SweepPart.stored_at.desc())
            .limit(RECENT)
            .subquery()
        )
        row = self.session.execute(
            sa.select(sa.func.sum(newest.c.elapsed_s), sa.func.sum(newest.c.simulated_s), sa.func.sum(newest.c.count))
        ).one()
        return row[0] or 0.0, row[1] or 0.0, row[2] or 0

    def remove_sweep(self, sweep: Sweep) -> None:
        for table in (SweepPart, SweepShard):
            self.session.execute(sa.delete(table).where(table.sweep_number == sweep.number))
        self.session.delete(sweep)
        self.session.flush()


def age(since: datetime | None, until: datetime | None) -> float | None:
    """Seconds between two times; None where one is missing."""
    return (until - since) / timedelta(seconds=1) if since and until else None
