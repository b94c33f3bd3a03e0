"""JSON forms of sweeps, and their results as JSON, CSV and Arrow."""

from __future__ import annotations

import json
from datetime import UTC, datetime

from app.calculations.answer import Made
from app.jobs.states import State
from app.models import Sweep
from app.sweeps.repository import Standing, age
from app.sweeps.schemas import ResultsOut, SweepDetail, SweepOut
from app.sweeps.service import columns_of, design_of, state
from app.sweeps.shown import axes, column
from rths_engine.sweeps.table import Table, arrow_bytes, csv_text

ARROW = "application/vnd.apache.arrow.stream"
DETAIL = ("sweep", "axes", "columns", "notes")


def out(sweep: Sweep, standing: Standing) -> SweepOut:
    """A sweep without its definition."""
    now = state(sweep, standing)
    ended = now.ended
    elapsed = age(standing.started_at, standing.finished_at if ended else datetime.now(UTC))
    done = standing.done
    running = now is State.RUNNING and done and elapsed is not None
    return SweepOut(
        id=sweep.id,
        number=sweep.number,
        name=sweep.name,
        method=sweep.method,
        state=now,
        points=sweep.points,
        done=done,
        completed=done - standing.tripped - standing.invalid - standing.failed,
        tripped=standing.tripped,
        invalid=standing.invalid,
        failed=standing.failed,
        share=done / sweep.points,
        remaining_s=elapsed * (sweep.points - done) / done if running and elapsed is not None else None,
        elapsed_s=elapsed,
        reason=_reason(sweep, now, standing),
        submitted_by=sweep.submitted_by,
        submitted_at=sweep.submitted_at,
        started_at=standing.started_at,
        finished_at=standing.finished_at if ended else None,
        code_version=sweep.code_version,
    )


def detail(sweep: Sweep, standing: Standing) -> SweepDetail:
    """A sweep with its definition."""
    design = design_of(sweep)
    return SweepDetail(
        **out(sweep, standing).model_dump(),
        sweep=sweep.definition,
        axes=axes(design),
        columns=[column(one) for one in columns_of(sweep)],
        notes=[*design.notes, *_unverified(standing)],
    )


def results(table: Table, sweep: Sweep, form: str, offset: int, limit: int | None) -> Made:
    """A page of results; without `limit`, all of them."""
    page = table.taken(slice(offset, None if limit is None else offset + limit))
    if form == "json":
        found = ResultsOut.model_construct(
            columns=[column(one) for one in table.columns],
            values=page.as_dict(),
            offset=offset,
            total=len(table.points),
            points=sweep.points,
        )
        body = {**found.__dict__, "columns": [one.model_dump() for one in found.columns]}
        return Made(json.dumps(body).encode(), "application/json")
    headers = {"Content-Disposition": f'attachment; filename="sweep-{sweep.id}.{form}"'}
    if form == "csv":
        return Made(csv_text(page).encode(), "text/csv; charset=utf-8", headers)
    return Made(arrow_bytes(page), ARROW, headers)


def _unverified(standing: Standing) -> list[str]:
    count = standing.unverified
    return [f"No checksum is stored for the results of {count} points: an earlier version computed them."] if count else []


def _reason(sweep: Sweep, now: State, standing: Standing) -> str | None:
    if now is State.CANCELLED:
        return f"Cancelled by {sweep.cancelled_by}. The points done are kept."
    return standing.reason if now is State.FAILED else None
