"""The queue service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import OneSession
from app.queue.service import QueueService


def queue_service(session: OneSession) -> QueueService:
    """The service of the queue in the session of the request."""
    return QueueService(session)


Queued = Annotated[QueueService, Depends(queue_service)]
