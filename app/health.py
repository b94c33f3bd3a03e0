"""Health of the service, for monitoring and the health check of the container."""

from __future__ import annotations

import asyncio
from typing import Literal

import anyio
import anyio.to_thread
from fastapi import APIRouter, FastAPI, Request, Response
from pydantic import BaseModel
from sqlalchemy.exc import SQLAlchemyError

from app.access import ANYONE, allowed
from app.db import unit_of_work
from app.jobs.workers import Workers
from rths_engine import __version__

router = APIRouter(tags=["health"])
OWN = anyio.CapacityLimiter(4)  # threads that no other request uses
PATIENCE_S = 3.0  # for the database


class Health(BaseModel):
    """State of the database and of the workers, and the version of the program."""

    database: Literal["ok", "silent"]
    worker: Literal["alive", "silent", "unknown"]
    version: str


@router.get("/healthz", responses={503: {"model": Health, "description": "The database or every worker is silent"}})
@allowed(ANYONE)
async def health(request: Request, response: Response) -> Health:
    """Report the health of the service: 200 while the database answers and a worker is alive, else 503."""
    try:
        async with asyncio.timeout(PATIENCE_S):
            beating = await anyio.to_thread.run_sync(_beating, request.app, limiter=OWN, abandon_on_cancel=True)
    except (SQLAlchemyError, TimeoutError):
        response.status_code = 503
        return Health(database="silent", worker="unknown", version=__version__)
    response.status_code = 200 if beating else 503
    return Health(database="ok", worker="alive" if beating else "silent", version=__version__)


class Alive(BaseModel):
    """The version of the program that answers."""

    version: str


@router.get("/livez")
@allowed(ANYONE)
async def alive() -> Alive:
    """Report that the web service answers, whatever its database, its workers and its disk do."""
    return Alive(version=__version__)


def _beating(app: FastAPI) -> bool:
    """Whether a worker is alive."""
    with unit_of_work(app.state.sessions) as session:
        workers = Workers(session)
        return workers.alive(workers.last_beat())
