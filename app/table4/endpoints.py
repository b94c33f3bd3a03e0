"""REST endpoints of the comparison with Table IV."""

from __future__ import annotations

from fastapi import APIRouter

from app.access import Role, allowed
from app.runs.schemas import Asking, RunOut, Submitted
from app.table4.dependency import Table4
from app.table4.schemas import TableOut

router = APIRouter(prefix="/api/v1/table4", tags=["runs"])


@router.get("")
@allowed(Role.VIEWER)
def table(table4: Table4) -> TableOut:
    """The newest run of each of the twelve simulations of Table IV, beside the paper's values."""
    return table4.table()


@router.post("", status_code=201)
@allowed(Role.ENGINEER)
def submit(table4: Table4, person: Asking) -> Submitted:
    """Queue the twelve simulations of Table IV on the emulated laboratory, with the bundled record."""
    return Submitted(runs=[RunOut.of(run) for run in table4.submit(person.by)])
