"""The queue as people see it: each test with the reason why it waits, and its expected start and end."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from sqlalchemy.orm import Session

from app.jobs.service import UNDO
from app.jobs.states import State
from app.jobs.tables import QueueState
from app.jobs.workers import Workers
from app.models import Run
from app.queue.expected import Expected, Span, Speeds, schedule
from app.queue.repository import QueueRepository, Waiting
from app.queue.schemas import QueueOut, RunningOut, UndoOut, WaitingOut
from app.runs.repository import RunRepository

SCHEDULED = 2000  # first tests of the queue whose times are computed
LEAST_SHARE = 0.05  # of a running test, from which its own speed tells its end


def outlook(session: Session, rows: QueueRepository, hold: QueueState, limit: int) -> QueueOut:
    """The queue with its first `limit` waiting tests."""
    now, workers, rigs = datetime.now(UTC), Workers(session), rows.rigs()
    seen, places = workers.last_beat(), workers.tests_at_a_time()
    running = RunRepository(session).in_states(State.RUNNING)
    line = rows.waiting(SCHEDULED)
    speeds = Speeds(rows.earlier(), busy=min(places, len(line) + len(running)) > 1)
    expected = [speeds.of(one) for one in line]
    left = [_left(run, speeds, now) for run in running]
    tests = [(one.rig_id, time.time_s) for one, time in zip(line, expected, strict=True)]
    spans = schedule([(run.rig_id, time) for run, time in zip(running, left, strict=True)], tests, places, rigs)
    waits = _Waits(hold, workers.alive(seen), running, places, rigs)
    total = max([span.end_s for span in spans if span.end_s is not None] + [time for time in left if time is not None] or [0.0])
    known = all(span.end_s is not None for span in spans) and all(time is not None for time in left)
    waiting = [
        _waiting(place, one, time, Span(None, None) if hold.held else span, waits.reason(one), now)
        for place, (one, time, span) in enumerate(zip(line, expected, spans, strict=True), start=1)
    ][:limit]
    return QueueOut(
        held=hold.held,
        held_by=hold.held_by,
        held_at=hold.held_at,
        held_reason=hold.held_reason,
        queued=rows.runs.count(State.QUEUED),
        running=[_running(run, time, now) for run, time in zip(running, left, strict=True)],
        waiting=waiting,
        undoable=[_undoable(run) for run in rows.cancelled_in_queue(now - UNDO)],
        total_s=total if known and len(line) < SCHEDULED else None,
        tests_at_a_time=places,
        worker_seen_at=seen,
        worker_alive=workers.alive(seen),
    )


class _Waits:
    """Why tests wait, asked in the order of the queue."""

    def __init__(self, hold: QueueState, alive: bool, running: Sequence[Run], places: int, rigs: dict[str, int | None]):
        self.hold, self.alive, self.running, self.places, self.rigs = hold, alive, running, places, rigs
        self.before = 0

    def reason(self, one: Waiting) -> str:
        """Why this test waits; the tests before it have been asked."""
        before, self.before = self.before, self.before + 1
        if not self.alive:
            return "no worker answers"
        if self.hold.held:
            return self.hold.sentence
        most = self.rigs.get(one.rig_id)
        on_rig = [run for run in self.running if run.rig_id == one.rig_id]
        if most is not None and len(on_rig) >= most:
            return f"waits for rig {one.rig_name}: {_runs(on_rig)}"
        if before:
            return f"{before} {'test is' if before == 1 else 'tests are'} before it"
        if len(self.running) >= self.places:
            return f"waits for a free place: {_runs(self.running)}"
        return "starts now"


def _runs(running: Sequence[Run]) -> str:
    numbers = [str(run.number) for run in running]
    if len(numbers) == 1:
        return f"run {numbers[0]} is running"
    if len(numbers) > 3:
        return f"{len(numbers)} runs are running"
    return f"runs {', '.join(numbers[:-1])} and {numbers[-1]} are running"


def _left(run: Run, speeds: Speeds, now: datetime) -> float | None:
    """Expected time (s) until a running test ends: by its own progress, and before there is any as if it waited."""
    elapsed = (now - run.started_at).total_seconds() if run.started_at else 0.0
    if run.share >= LEAST_SHARE:
        return max(0.0, elapsed / run.share - elapsed)
    time_s = speeds.of(run).time_s
    return None if time_s is None else max(0.0, time_s - elapsed)


def _undoable(run: Run) -> UndoOut:
    assert run.finished_at is not None
    named = {"id": run.id, "number": run.number, "name": run.name, "rig_id": run.rig_id}
    return UndoOut(**named, reason=run.reason or "", until=run.finished_at + UNDO)


def _running(run: Run, left_s: float | None, now: datetime) -> RunningOut:
    out = RunningOut.of(run)
    out.expected_end = _at(now, left_s)
    return out


def _waiting(place: int, one: Waiting, time: Expected, span: Span, waits: str, now: datetime) -> WaitingOut:
    shared = {name: getattr(one, name) for name in WaitingOut.model_fields if name in Waiting._fields}
    return WaitingOut(
        **{**shared, "position": place, "rig_name": one.rig_name or one.rig_id},
        waits=waits,
        expected_s=time.time_s,
        expected_from=time.source,
        expected_start=_at(now, span.start_s),
        expected_end=_at(now, span.end_s),
    )


def _at(now: datetime, after_s: float | None) -> datetime | None:
    return None if after_s is None else now + timedelta(seconds=after_s)
