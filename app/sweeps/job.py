"""Shards of sweeps as a kind of job: consecutive points of one sweep, executed by one process that is kept warm."""

from __future__ import annotations

from dataclasses import asdict
from datetime import UTC, datetime
from hashlib import sha256

from sqlalchemy.orm import object_session

from app.config import Settings
from app.jobs.kind import Ending, Kind
from app.jobs.service import NOBODY
from app.jobs.states import State
from app.models import SweepPart, SweepShard
from app.sweeps.order import ShardEnd, ShardOrder, ShardPart
from app.sweeps.repository import SweepRepository


class ShardKind(Kind[SweepShard, ShardOrder, ShardEnd]):
    """Shards as a kind of job: one process for each core, with a lower priority than tests.

    The results of points are stored as parts while a shard runs, so a shard that starts again executes only the other points.
    """

    name, noun, table = "shard", "shard of the sweep", SweepShard
    queue, workflow = "sweeps", "run-shard"
    process = "app.worker.sweep"
    again = "Resume the sweep to execute the points without results."
    niceness = 10
    kept_warm = keeps_when_cancelled = True
    started_early = told = False
    ahead = 2
    polling_s = 0.25  # a cancelled shard stops within half a second

    def at_a_time(self, settings: Settings) -> int:
        return settings.sweep_processes

    def queued_version(self, job: SweepShard) -> str:
        return job.sweep.code_version

    def order(self, job: SweepShard, settings: Settings) -> ShardOrder:
        session, sweep = object_session(job), job.sweep
        assert session is not None
        end = job.first + job.count
        done = SweepRepository(session).spans(sweep.number, job.first, end)
        spans = tuple(left([(job.first, end)], done))
        return ShardOrder(job.id, job.attempt, sweep.id, sweep.definition, tuple(sweep.columns), spans, settings)

    def store_part(self, job: SweepShard, part: ShardPart) -> None:
        session = object_session(job)
        assert session is not None
        if session.get(SweepPart, (job.sweep_number, part.first)) is not None:
            return  # stored before; the answer of the database got lost
        checksum = sha256(part.values).hexdigest()
        row = SweepPart(sweep_number=job.sweep_number, stored_at=datetime.now(UTC), sha256=checksum, **asdict(part))
        SweepRepository(session).add_part(row)

    def store(self, job: SweepShard, result: ShardEnd) -> Ending:
        if result.cancelled:
            return Ending(State.CANCELLED, f"Cancelled by {job.cancel_requested_by or NOBODY}. The points done are kept.")
        return Ending(State.COMPLETED, "All points have results.")


SHARDS = ShardKind()


def left(spans: list[tuple[int, int]], done: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """What the spans `done` leave of `spans`; both are in order and each without overlaps."""
    found = []
    for first, end in spans:
        for start, stop in done:
            if stop <= first or start >= end:
                continue
            if start > first:
                found.append((first, start))
            first = stop
        if first < end:
            found.append((first, end))
    return found
