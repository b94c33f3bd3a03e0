"""The Table IV service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.runs.dependency import Runs
from app.table4.service import Table4Service


def table4_service(runs: Runs) -> Table4Service:
    """The service of Table IV."""
    return Table4Service(runs)


Table4 = Annotated[Table4Service, Depends(table4_service)]
