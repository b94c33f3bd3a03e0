"""Whether the service works: for monitoring and the container's health check."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse
from sqlalchemy.exc import SQLAlchemyError

from app.db import unit_of_work
from app.jobs.workers import Workers, alive
from rths_engine import __version__

router = APIRouter(tags=["health"])


@router.get("/healthz")
def health(request: Request) -> JSONResponse:
    """200 while the database answers and a worker is alive, else 503."""
    try:
        with unit_of_work(request.app.state.sessions) as session:
            seen = Workers(session).last_beat()
    except SQLAlchemyError:
        return JSONResponse({"database": "silent", "worker": "unknown", "version": __version__}, 503)
    beating = alive(seen)
    body = {"database": "ok", "worker": "alive" if beating else "silent", "version": __version__}
    return JSONResponse(body, 200 if beating else 503)
