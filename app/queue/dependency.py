"""The queue service of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from app.dependencies import OneSession
from app.queue.service import QueueService


def queue_service(request: Request, session: OneSession) -> QueueService:
    """The service of the queue in the session of the request."""
    return QueueService(session, request.app.state.desk.latch)


Queued = Annotated[QueueService, Depends(queue_service)]
