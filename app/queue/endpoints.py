"""REST endpoints of the queue of tests."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query

from app.access import Role, allowed
from app.openapi import told
from app.queue.dependency import Queued
from app.queue.schemas import MOST_RUNS, Cancelled, CancelledOut, HoldIn, Move, NewPriority, QueueOut
from app.runs.schemas import Asking

router = APIRouter(prefix="/api/v1", tags=["queue"])


@router.get("/queue")
@allowed(Role.VIEWER)
def queue(queued: Queued, limit: Annotated[int, Query(ge=1, le=MOST_RUNS)] = 200) -> QueueOut:
    """The queue: held or not, running tests, and waiting tests in their order with reason, expected start and end."""
    return queued.state(limit)


@router.post("/queue/order", responses=told(404))
@allowed(Role.OPERATOR)
def order(move: Annotated[Move, Body()], queued: Queued) -> QueueOut:
    """Move queued runs before or after another queued run, or to the top or the bottom of the queue.

    They take the priority of their new neighbour, because higher priorities start first. Where one person drives a rig, only
    the driver of the rigs of these runs moves them.
    """
    queued.move(move)
    return queued.state()


@router.post("/queue/priority", responses=told(404))
@allowed(Role.OPERATOR)
def priority(asked: Annotated[NewPriority, Body()], queued: Queued) -> QueueOut:
    """Give queued runs a priority. Runs of a higher priority start first, whatever their position.

    Where one person drives a rig, only the driver of the rigs of these runs does so.
    """
    queued.prioritise(asked.runs, asked.priority, asked.by)
    return queued.state()


@router.post("/queue/cancel")
@allowed(Role.OPERATOR)
def cancel(asked: Annotated[Cancelled, Body()], queued: Queued) -> CancelledOut:
    """Cancel several queued or running runs. Runs that have ended are left as they are, each with its reason."""
    return queued.cancel(asked.runs, asked.by)


@router.post("/queue/hold")
@allowed(Role.OPERATOR)
def hold(asked: Annotated[HoldIn, Body()], queued: Queued) -> QueueOut:
    """Hold the queue: queued tests do not start, running tests go on. The reason is shown until the release."""
    queued.hold_it(asked.by, asked.reason)
    return queued.state()


@router.post("/queue/release")
@allowed(Role.OPERATOR)
def release(queued: Queued, person: Asking) -> QueueOut:
    """Release the queue after a hold or an abort, so that queued tests start."""
    queued.release(person.by)
    return queued.state()
