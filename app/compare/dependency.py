"""The service of comparisons of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.compare.service import CompareService
from app.dependencies import Configured
from app.measured.dependency import Recordings
from app.runs.dependency import Runs


def compare_service(runs: Runs, recordings: Recordings, configured: Configured) -> CompareService:
    """The service of comparisons in the session of the request."""
    return CompareService(runs, recordings, configured)


Comparisons = Annotated[CompareService, Depends(compare_service)]
