"""Metrics of one process for Prometheus: names, labels and buckets. Labels have few values: no ids, no names of people."""

from __future__ import annotations

from prometheus_client import (
    CollectorRegistry,
    Counter,
    Gauge,
    Histogram,
    PlatformCollector,
    ProcessCollector,
    disable_created_metrics,
)

REGISTRY = CollectorRegistry()
"""The metrics of this process; of a worker they reach the database, see app/worker/reporting.py."""
disable_created_metrics()  # type: ignore[no-untyped-call]  # the times since when each sample counts would double the text
ProcessCollector(registry=REGISTRY)
PlatformCollector(registry=REGISTRY)

REQUESTS = Counter("rths_requests", "Requests answered", ["method", "route", "status"], registry=REGISTRY)
REQUEST_SECONDS = Histogram(
    "rths_request_seconds",
    "Time from the start of a request to the end of its answer",
    ["method", "route"],
    buckets=(0.005, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 30.0),
    registry=REGISTRY,
)
ABORT_SECONDS = Histogram(
    "rths_abort_seconds",
    "Time from an Abort request to its acknowledgement",
    buckets=(0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 30.0),
    registry=REGISTRY,
)
IN_PROGRESS = Gauge("rths_requests_in_progress", "Requests that are being answered", registry=REGISTRY)
SOCKETS = Gauge("rths_websockets", "Open websockets: of viewers and of workers", ["side"], registry=REGISTRY)
FRAME_LAG_SECONDS = Histogram(
    "rths_frame_lag_seconds",
    "Time from the arrival of a frame at the service to its sending to a viewer",
    buckets=(0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0),
    registry=REGISTRY,
)
REFUSED = Counter("rths_refused", "Requests refused because a limit was reached", ["reason"], registry=REGISTRY)
STATEMENT_SECONDS = Histogram(
    "rths_database_statement_seconds",
    "Time of a statement in the database",
    buckets=(0.0005, 0.001, 0.0025, 0.005, 0.01, 0.05, 0.1, 0.5, 1.0, 5.0, 30.0),
    registry=REGISTRY,
)
WAIT_SECONDS = Histogram(
    "rths_job_wait_seconds",
    "Time from the submission of a job to its start",
    ["kind"],
    buckets=(0.1, 0.5, 1.0, 5.0, 15.0, 60.0, 300.0, 900.0, 3600.0, 14_400.0, 86_400.0),
    registry=REGISTRY,
)
RUN_SECONDS = Histogram(
    "rths_job_seconds",
    "Time from the start of a job to its end",
    ["kind", "state"],
    buckets=(0.1, 0.5, 1.0, 5.0, 15.0, 60.0, 300.0, 900.0, 3600.0, 14_400.0),
    registry=REGISTRY,
)
ENGINE_STEPS = Counter("rths_engine_steps", "Controller steps of tests that ran in real time", registry=REGISTRY)
MISSED_DEADLINES = Counter(
    "rths_engine_missed_deadlines", "Controller steps that ended after their deadline", registry=REGISTRY
)
