"""The services of measured recordings and of batches of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.calculations.answer import Calculating
from app.dependencies import Configured, OneSession, OneStore
from app.measured.batches import UNPACKED, BatchService
from app.measured.service import MeasuredService


def measured_service(session: OneSession, store: OneStore, calculate: Calculating) -> MeasuredService:
    """The service of measured recordings in the session of the request."""
    return MeasuredService(session, store, calculate)


Recordings = Annotated[MeasuredService, Depends(measured_service)]


def batch_service(recordings: Recordings, configured: Configured) -> BatchService:
    """The service of batches in the session of the request."""
    return BatchService(recordings, UNPACKED * configured.measurements_limit)


Batches = Annotated[BatchService, Depends(batch_service)]
