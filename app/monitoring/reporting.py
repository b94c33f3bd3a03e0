"""Metrics of workers: each worker writes its own into the database, and the web service shows them with the worker's name."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterable
from datetime import UTC, datetime, timedelta

import sqlalchemy as sa
from prometheus_client import Metric, generate_latest
from prometheus_client.metrics_core import METRIC_TYPES
from prometheus_client.parser import text_string_to_metric_families
from sqlalchemy.orm import Session, sessionmaker

from app import metrics
from app.db import put, unit_of_work
from app.models import WorkerMetrics

log = logging.getLogger("rths.worker")
EVERY_S = 5.0
FRESH = timedelta(seconds=30)  # what a worker wrote earlier is not shown: it is gone
FORGOTTEN = timedelta(hours=1)
PREFIX = "rths_worker"


def start(maker: sessionmaker[Session], worker: str) -> None:
    """Write the metrics of this process into the database from now on, in a thread of its own."""
    threading.Thread(target=_keep, args=(maker, worker), daemon=True, name="rths-metrics").start()


def _keep(maker: sessionmaker[Session], worker: str) -> None:
    pause = threading.Event()
    while True:
        try:
            report(maker, worker)
        except sa.exc.SQLAlchemyError as error:
            log.info("the metrics were not stored: %s", error)
        pause.wait(EVERY_S)


def report(maker: sessionmaker[Session], worker: str) -> None:
    """Write the metrics of this process once, and forget those of workers that are long gone."""
    now = datetime.now(UTC)
    with unit_of_work(maker) as session:
        put(session, WorkerMetrics, "worker", worker=worker, at=now, text=generate_latest(metrics.REGISTRY).decode())
        session.execute(sa.delete(WorkerMetrics).where(WorkerMetrics.at < now - FORGOTTEN))


def reported(session: Session) -> Iterable[Metric]:
    """The metrics of the workers, `rths_worker_...`, each sample with the label `worker`."""
    families: dict[str, Metric] = {}
    fresh = sa.select(WorkerMetrics).where(WorkerMetrics.at >= datetime.now(UTC) - FRESH).order_by(WorkerMetrics.worker)
    for row in session.scalars(fresh):
        for family in text_string_to_metric_families(row.text):
            name = f"{PREFIX}_{family.name.removeprefix('rths_')}"
            kind = family.type if family.type in METRIC_TYPES else "unknown"
            kept = families.setdefault(name, Metric(name, family.documentation, kind))
            for sample in family.samples:
                if not sample.name.endswith("_created"):
                    own = sample.name.replace(family.name, name, 1)
                    kept.add_sample(own, {**sample.labels, "worker": row.worker}, sample.value)
    return families.values()
