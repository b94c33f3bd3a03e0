"""Heartbeats of workers, and what one worker observes of the others. Never commits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import datetime, timedelta

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import now, put
from app.jobs.tables import WorkerHeartbeat

SILENT_LOOKS = 6  # looks of a worker, one a second, in which another has no new heartbeat: it counts as dead
WORKER_SILENCE = timedelta(seconds=SILENT_LOOKS)  # the same for people, by the clock of the database
KEPT = timedelta(days=1)  # how long the last heartbeat of a dead worker is kept


class Workers:
    """Heartbeats of the workers. A worker is one process from its start to its end: a restart is another worker.

    Times are those of the database, so that no worker depends on the clock of another machine.
    """

    def __init__(self, session: Session):
        self.session = session

    def beat(self, worker: str, tests_at_a_time: int = 1) -> None:
        """Store a heartbeat. A worker and the web service that beats for it may do so at the same moment."""
        put(self.session, WorkerHeartbeat, "worker", worker=worker, seen_at=now(self.session), tests_at_a_time=tests_at_a_time)

    def beats(self) -> dict[str, datetime]:
        """The last heartbeat of each worker."""
        rows = self.session.execute(sa.select(WorkerHeartbeat.worker, WorkerHeartbeat.seen_at))
        return {worker: seen for worker, seen in rows}

    def tests_at_a_time(self) -> int:
        """Number of tests that all living workers together execute at the same time."""
        since, until = now(self.session) - WORKER_SILENCE, now(self.session) + WORKER_SILENCE
        living = WorkerHeartbeat.seen_at.between(since, until)
        return self.session.scalar(sa.select(sa.func.sum(WorkerHeartbeat.tests_at_a_time)).where(living)) or 0

    def last_beat(self) -> datetime | None:
        """The newest heartbeat; of those that a clock set back has left in the future, only where there is no other."""
        past = WorkerHeartbeat.seen_at <= now(self.session) + WORKER_SILENCE
        newest = sa.select(WorkerHeartbeat.seen_at).order_by(past.desc(), WorkerHeartbeat.seen_at.desc()).limit(1)
        return self.session.scalar(newest)

    def alive(self, seen: datetime | None) -> bool:
        """Whether a worker with its last heartbeat at `seen` counts as alive."""
        return seen is not None and abs(now(self.session) - seen) < WORKER_SILENCE

    def forget(self, worker: str) -> None:
        """Remove the heartbeat of a worker that has ended: whatever it holds is taken over at the next look of another."""
        self.session.execute(sa.delete(WorkerHeartbeat).where(WorkerHeartbeat.worker == worker))

    def forget_old(self, dead: Iterable[str]) -> None:
        """Remove the heartbeats of dead workers that are older than KEPT."""
        old = WorkerHeartbeat.seen_at < now(self.session) - KEPT
        self.session.execute(sa.delete(WorkerHeartbeat).where(WorkerHeartbeat.worker.in_(list(dead)), old))


class Watch:
    """What a worker observes of the others: a heartbeat that changes is a sign of life, whatever time it carries.

    A worker is dead when SILENT_LOOKS looks in a row found no new heartbeat. No clock is read, so neither a clock that jumps
    nor a pause of the observer makes a living worker dead, or a dead one live.
    """

    def __init__(self) -> None:
        self._last: dict[str, tuple[datetime, int]] = {}

    def look(self, beats: Mapping[str, datetime]) -> set[str]:
        """Take one look at the heartbeats; returns the workers that count as dead."""
        looked: dict[str, tuple[datetime, int]] = {}
        for worker, seen in beats.items():
            before, silent = self._last.get(worker, (None, 0))
            looked[worker] = (seen, silent + 1 if seen == before else 0)
        self._last = looked
        return {worker for worker, (_, silent) in looked.items() if silent >= SILENT_LOOKS}
