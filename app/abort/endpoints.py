"""REST endpoints of Abort: coroutines that wait for no thread, no connection of the database and no lock."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Depends, Request

from app.abort.desk import Desk
from app.abort.schemas import AbortOut
from app.access import Role, Scope, allowed, person
from app.audit.requests import given_in
from app.runs.schemas import Person

router = APIRouter(prefix="/api/v1", tags=["queue"])
NOBODY = Person()


@router.post("/abort", dependencies=[Depends(given_in)])
@allowed(Role.VIEWER, *Scope, remembered=True)
async def abort(request: Request, by: Annotated[Person, Body()] = NOBODY) -> AbortOut:
    """Stop every running test and hold the queue. This is not the laboratory's emergency stop.

    The latch of the service is set at once and sent to every worker; the record in the database follows, and is repeated until
    it is stored. The response says which workers have acknowledged and whether the hold is recorded.
    """
    desk: Desk = request.app.state.desk
    return await desk.press(person(request).named(by.by))


@router.get("/abort")
@allowed(Role.VIEWER, *Scope, remembered=True)
async def state(request: Request) -> AbortOut:
    """Whether Abort is pressed, which workers have acknowledged, what still stops, and whether the hold is recorded."""
    desk: Desk = request.app.state.desk
    return desk.state()
