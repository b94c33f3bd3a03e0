"""Runs as a kind of job: each engine process executes one test at a time."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import aliased, object_session

from app import metrics
from app.config import Settings
from app.jobs.kind import Ending, Kind
from app.jobs.service import NOBODY
from app.jobs.states import State
from app.models import Approval, Rig, Run, RunStation
from app.runs import values
from app.runs.order import WAITING, Outcome, RunOrder
from app.store.filed import RECORDINGS, of_run
from app.store.opening import store_of
from rths_engine.foundation.part import validated
from rths_engine.planning.connections import external
from rths_engine.planning.plan import Plan
from rths_engine.results.measure import FloorMeasure, RunMeasure
from rths_engine.results.measures import of

UNSENT = "unsent"
assert values  # the import makes values follow from runs


class RunKind(Kind[Run, RunOrder, Outcome]):
    """Runs as a kind of job: watched live, stored when cancelled, and waiting while the queue is held."""

    name, noun, table = "run", "test", Run
    queue, workflow = "tests", "run-test"
    process = "app.worker.engine"
    again = "Retry it to execute it again."
    ordered = kept_warm = keeps_when_cancelled = waits_while_held = watched_live = True

    def at_a_time(self, settings: Settings) -> int:
        return settings.worker_concurrency

    def title(self, job: Run) -> str:
        return job.name

    def may_start(self) -> sa.ColumnElement[bool]:
        """A test waits while its rig executes as many tests as it takes at a time. A deleted test never starts."""
        other = aliased(Run)
        running = sa.select(sa.func.count()).where(other.state == State.RUNNING, other.rig_id == Rig.id).correlate(Rig)
        busy = sa.select(Rig.id).where(Rig.tests_at_a_time <= running.scalar_subquery())
        return Run.deleted_at.is_(None) & Run.rig_id.not_in(busy)

    def not_repeated(self, job: Run) -> str | None:
        """A test that drove a rig, which now stands nobody knows how, or one whose client had connected."""
        plan = validated(Plan, job.plan)
        if plan.test == "client" and job.doing and not job.doing.startswith(WAITING):
            return "Its client had connected, so the test is not started again by itself. Retry it, then start the client."
        found = external(plan)
        if not found:
            return f"The test was on the rig {job.rig_name}. Inspect the rig, then retry." if _physical(job) else None
        named = ", ".join(connection.peer for connection in found.values())
        return f"The test drove an external rig ({named}), so it is not started again by itself. Inspect the rig, then retry."

    def order(self, job: Run, settings: Settings) -> RunOrder:
        recording = store_of(settings).scratch(RECORDINGS) / f".{job.id}.{job.attempt}.h5"
        given = (job.id, job.attempt, job.plan, recording.resolve(), settings, _approved(job))
        return RunOrder(*given, moves=_physical(job) or bool(external(validated(Plan, job.plan))))

    def store(self, job: Run, result: Outcome) -> Ending:
        summary = _finite(result.summary)
        job.trip, job.client = summary["trip"], summary.get("client")
        job.timing = summary.get("timing")
        if job.timing:
            metrics.ENGINE_STEPS.inc(job.timing.get("steps", 0))
            metrics.MISSED_DEADLINES.inc(job.timing.get("missed", 0))
        job.elapsed_s, job.simulated_s = summary["elapsed_s"], summary["simulated_s"]
        for one in (*of(FloorMeasure), *of(RunMeasure)):
            setattr(job, one.key, summary.get(one.key))  # a worker of an earlier version sends no later measures
        job.recording_sha256, job.recording_size = result.recording_sha256, result.recording_size
        job.stations = [RunStation(number=number, **station) for number, station in enumerate(summary["stations"], start=1)]
        state = State(summary["status"])
        return Ending(state, _reason(job, state))

    def place(self, order: RunOrder, settings: Settings) -> None:
        """Move the recording to the store, just before the commit of its row. After a failure both are done again.

        Where the store fails, the recording stays in the folder `unsent` of the worker's data folder.
        """
        try:
            store_of(settings).put(order.recording, of_run(order.job_id))
        except OSError as error:
            kept = _kept(order.recording, settings.data / UNSENT / f"{order.job_id}.{order.attempt}.h5")
            raise OSError(f"{error.strerror or error}. {kept}".removesuffix(".")) from error

    def discard(self, order: RunOrder) -> None:
        order.recording.unlink(missing_ok=True)

    def clear(self, job: Run, settings: Settings) -> None:
        store = store_of(settings)
        for path in store.scratch(RECORDINGS).glob(f"*{job.id}*"):
            if path.name != f"{job.id}.h5":
                path.unlink(missing_ok=True)
        if not job.recording_sha256 and job.attempt > 1:
            store.delete(of_run(job.id))


RUNS = RunKind()


def _physical(run: Run) -> bool:
    return run.rig is not None and run.rig.kind == "physical"


def _approved(run: Run) -> str:
    """The digest of the plan that a person approved; empty where none was needed."""
    session = object_session(run)
    assert session is not None
    query = sa.select(Approval.digest).where(Approval.about_id == run.id, Approval.decision == "approved")
    return session.scalar(query.order_by(Approval.number.desc()).limit(1)) or ""


def _kept(recording: Path, target: Path) -> str:
    """Keep a recording that cannot be stored; returns where it is."""
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        os.replace(recording, target)
    except OSError as error:
        return f"The recording is lost: {error.strerror}."
    return f"The recording is kept on its worker: {target.resolve()}."


def _reason(run: Run, state: State) -> str:
    if state is State.CANCELLED:
        return f"Stopped by {run.cancel_requested_by or NOBODY} at {run.simulated_s:.2f} s."
    if run.client and not run.trip:
        return str(run.client["ended"])
    return run.trip["sentence"] if run.trip else "The test ran to its end."


def _finite(summary: dict[str, Any]) -> dict[str, Any]:
    """The summary with null for numbers that are not finite: JSON in a database cannot hold them."""
    found: dict[str, Any] = json.loads(json.dumps(summary), parse_constant=lambda _: None)
    return found
