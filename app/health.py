"""Whether the service works: for monitoring and the container's health check."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from app.dependencies import Runs
from rths_engine import __version__

router = APIRouter(tags=["health"])


@router.get("/healthz")
def health(runs: Runs) -> JSONResponse:
    """200 while the database answers and a worker is alive, else 503."""
    queue = runs.queue_state()
    body: dict[str, Any] = {"database": "ok", "worker": "alive" if queue.worker_alive else "silent", "version": __version__}
    return JSONResponse(body, 200 if queue.worker_alive else 503)
