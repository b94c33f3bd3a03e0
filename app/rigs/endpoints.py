"""REST endpoints of rigs."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import Response

from app.access import Role, allowed
from app.rigs.dependency import Rigs
from app.rigs.schemas import RigChange, RigIn, RigList, RigOut

router = APIRouter(prefix="/api/v1/rigs", tags=["rigs"])


@router.get("")
@allowed(Role.VIEWER)
def listed(rigs: Rigs) -> RigList:
    """List the rigs with their capacities, and how many tests run on each and wait for it."""
    return RigList(rigs=rigs.listed())


@router.post("", status_code=201)
@allowed(Role.ADMINISTRATOR)
def add(given: Annotated[RigIn, Body()], rigs: Rigs) -> RigOut:
    """Add a rig. A physical rig executes one test at a time, an emulated rig as many as wished unless it states a number."""
    return rigs.add(given)


@router.get("/{rig_id}")
@allowed(Role.VIEWER)
def one(rig_id: str, rigs: Rigs) -> RigOut:
    """A rig with its capacities."""
    return rigs.shown(rig_id)


@router.put("/{rig_id}")
@allowed(Role.ADMINISTRATOR)
def change(rig_id: str, given: Annotated[RigChange, Body()], rigs: Rigs) -> RigOut:
    """Change a rig. Refused where a plan that waits for it would exceed a capacity."""
    return rigs.change(rig_id, given)


@router.delete("/{rig_id}", status_code=204, response_class=Response)
@allowed(Role.ADMINISTRATOR)
def remove(rig_id: str, rigs: Rigs) -> None:
    """Delete a rig that no run names. Retire a rig whose runs are to stay."""
    rigs.remove(rig_id)
