"""Heartbeats of workers. Never commits."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.tables import WorkerHeartbeat

WORKER_SILENCE = timedelta(seconds=6)  # six heartbeats; after this silence a worker counts as dead


class Workers:
    """Heartbeats of the workers."""

    def __init__(self, session: Session):
        self.session = session

    def beat(self, worker: str, tests_at_a_time: int = 1) -> None:
        self.session.merge(WorkerHeartbeat(worker=worker, seen_at=datetime.now(UTC), tests_at_a_time=tests_at_a_time))

    def tests_at_a_time(self) -> int:
        """Number of tests that all living workers together execute at the same time."""
        since = datetime.now(UTC) - WORKER_SILENCE
        total = sa.select(sa.func.sum(WorkerHeartbeat.tests_at_a_time)).where(WorkerHeartbeat.seen_at >= since)
        return self.session.scalar(total) or 0

    def last_beat(self) -> datetime | None:
        newest = sa.select(WorkerHeartbeat).order_by(WorkerHeartbeat.seen_at.desc()).limit(1)
        found = self.session.scalar(newest)
        return found.seen_at if found else None

    def silent(self) -> list[str]:
        """Workers that count as dead."""
        before = datetime.now(UTC) - WORKER_SILENCE
        return list(self.session.scalars(sa.select(WorkerHeartbeat.worker).where(WorkerHeartbeat.seen_at < before)))

    def forget(self, worker: str) -> None:
        self.session.execute(sa.delete(WorkerHeartbeat).where(WorkerHeartbeat.worker == worker))


def alive(seen: datetime | None) -> bool:
    """Whether a worker with its last heartbeat at `seen` counts as alive."""
    return seen is not None and datetime.now(UTC) - seen < WORKER_SILENCE
