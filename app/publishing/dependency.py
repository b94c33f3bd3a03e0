"""The service of reports of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.annotations.dependency import Annotations
from app.dependencies import Configured
from app.diagnoses.dependency import Diagnoses
from app.laboratory.dependency import OneLaboratory
from app.publishing.service import Publishing
from app.runs.dependency import Runs


def publishing(
    runs: Runs, annotations: Annotations, diagnoses: Diagnoses, laboratory: OneLaboratory, configured: Configured
) -> Publishing:
    """The service of reports in the session of the request."""
    return Publishing(runs, annotations, diagnoses, laboratory, configured)


Reports = Annotated[Publishing, Depends(publishing)]
