"""What endpoints ask for: settings, a session that commits once, and the services on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from fastapi import Depends, Request
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import unit_of_work
from app.motions.service import MotionService
from app.plans.service import PlanService
from app.runs.service import RunService
from rths_engine.ground_motions import MotionLibrary


def settings(request: Request) -> Settings:
    found: Settings = request.app.state.settings
    return found


def session(request: Request) -> Iterator[Session]:
    with unit_of_work(request.app.state.sessions) as one:
        yield one


Configured = Annotated[Settings, Depends(settings)]
OneSession = Annotated[Session, Depends(session, scope="function")]


def library(configured: Configured) -> MotionLibrary:
    return MotionLibrary(configured.motions)


Library = Annotated[MotionLibrary, Depends(library)]


def run_service(request: Request, one: OneSession, motions: Library) -> RunService:
    return RunService(one, motions, request.app.state.queue)


def motion_service(motions: Library) -> MotionService:
    return MotionService(motions)


def plan_service(motions: Library) -> PlanService:
    return PlanService(motions)


Runs = Annotated[RunService, Depends(run_service)]
Motions = Annotated[MotionService, Depends(motion_service)]
Plans = Annotated[PlanService, Depends(plan_service)]
