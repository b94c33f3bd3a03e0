"""Health of the service, for monitoring and the health check of the container."""

from __future__ import annotations

from typing import Literal

from fastapi import APIRouter, Request, Response
from pydantic import BaseModel
from sqlalchemy.exc import SQLAlchemyError

from app.access import ANYONE, allowed
from app.db import unit_of_work
from app.jobs.workers import Workers
from rths_engine import __version__

router = APIRouter(tags=["health"])


class Health(BaseModel):
    """State of the database and of the workers, and the version of the program."""

    database: Literal["ok", "silent"]
    worker: Literal["alive", "silent", "unknown"]
    version: str


@router.get("/healthz", responses={503: {"model": Health, "description": "The database or every worker is silent"}})
@allowed(ANYONE)
def health(request: Request, response: Response) -> Health:
    """Report the health of the service: 200 while the database answers and a worker is alive, else 503."""
    try:
        with unit_of_work(request.app.state.sessions) as session:
            workers = Workers(session)
            beating = workers.alive(workers.last_beat())
    except SQLAlchemyError:
        response.status_code = 503
        return Health(database="silent", worker="unknown", version=__version__)
    response.status_code = 200 if beating else 503
    return Health(database="ok", worker="alive" if beating else "silent", version=__version__)
