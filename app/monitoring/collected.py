"""Metrics that are read when they are asked for: jobs, workers, disk, and the live runs of this process."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from datetime import UTC, datetime
from typing import Any

import sqlalchemy as sa
from prometheus_client import Metric
from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector
from sqlalchemy.orm import Session, sessionmaker

from app import disk
from app.config import Settings
from app.db import unit_of_work
from app.jobs.kind import Kind
from app.jobs.states import State
from app.jobs.tables import Job, QueueState
from app.jobs.workers import Workers
from app.live.hub import Hub
from app.monitoring.reporting import reported

KEPT_S = 5.0  # several Prometheus servers, or replicas, count the rows once


class Collected(Collector):
    """What the database, the disk and the hub hold now. Without the database only `rths_database_up 0` remains of its part."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], hub: Hub, kinds: Sequence[Kind[Any, Any, Any]]):
        self.settings, self.maker, self.hub, self.kinds = settings, maker, hub, kinds
        self._rows: tuple[float, list[Metric]] = (-KEPT_S, [])

    def describe(self) -> Iterable[Metric]:
        return ()

    def collect(self) -> Iterator[Metric]:
        yield _gauge("rths_live_runs", "Runs whose frames arrive at this process", len(self.hub.runs))
        yield from self._of_disk()
        at, found = self._rows
        if time.monotonic() - at >= KEPT_S:
            found = list(self._of_database())
            self._rows = time.monotonic(), found
        yield from found

    def _of_disk(self) -> Iterator[Metric]:
        try:
            found = disk.space(self.settings)
        except OSError:
            return
        yield _gauge("rths_disk_free_bytes", "Free space of the disk of the data folder", found.free)
        yield _gauge("rths_disk_reserve_bytes", "Space that the disk guard keeps free", found.reserve)

    def _of_database(self) -> Iterator[Metric]:
        begun = time.perf_counter()
        try:
            with unit_of_work(self.maker) as session:
                session.execute(sa.select(1))
                answered = time.perf_counter() - begun
                found = [*self._of_jobs(session), *_of_workers(session), *reported(session)]
        except sa.exc.SQLAlchemyError:
            yield _gauge("rths_database_up", "Whether the database answers", 0)
            return
        yield _gauge("rths_database_up", "Whether the database answers", 1)
        yield _gauge("rths_database_answer_seconds", "Time in which the database answered the shortest question", answered)
        yield from found

    def _of_jobs(self, session: Session) -> Iterator[Metric]:
        states = GaugeMetricFamily("rths_jobs", "Jobs by kind and state", labels=["kind", "state"])
        waits = GaugeMetricFamily("rths_queue_oldest_seconds", "Age of the job that waits longest", labels=["kind"])
        for kind in self.kinds:
            table: type[Job] = kind.table
            counted = dict.fromkeys(State, 0)
            counted |= {state: n for state, n in session.execute(sa.select(table.state, sa.func.count()).group_by(table.state))}
            for state, number in counted.items():
                states.add_metric([kind.name, str(state)], number)
            oldest = session.scalar(sa.select(sa.func.min(table.submitted_at)).where(table.state == State.QUEUED))
            waits.add_metric([kind.name], (datetime.now(UTC) - oldest).total_seconds() if oldest else 0.0)
        yield from (states, waits)


def _of_workers(session: Session) -> Iterator[Metric]:
    workers = Workers(session)
    alive = [seen for seen in workers.beats().values() if workers.alive(seen)]
    yield _gauge("rths_workers_alive", "Workers that wrote a heartbeat in time", len(alive))
    tests = workers.tests_at_a_time()
    yield _gauge("rths_workers_tests_at_a_time", "Tests that the living workers execute at the same time", tests)
    held = session.scalar(sa.select(QueueState.held).where(QueueState.id == 1))
    yield _gauge("rths_queue_held", "Whether the queue of tests is held", int(bool(held)))


def _gauge(name: str, about: str, value: float) -> Metric:
    return GaugeMetricFamily(name, about, value=value)
