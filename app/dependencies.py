"""Dependencies of all endpoints: settings, a session that commits once, and the library of ground motions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from fastapi import Depends, Request
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import unit_of_work
from rths_engine.parts.ground_motions import MotionLibrary


def settings(request: Request) -> Settings:
    """The settings of this application."""
    found: Settings = request.app.state.settings
    return found


def session(request: Request) -> Iterator[Session]:
    """A session that commits at the end of a request without errors."""
    with unit_of_work(request.app.state.sessions) as one:
        yield one


Configured = Annotated[Settings, Depends(settings)]
OneSession = Annotated[Session, Depends(session, scope="function")]


def library(configured: Configured) -> MotionLibrary:
    """The library of ground motions: bundled and added records."""
    return MotionLibrary(configured.motions)


Library = Annotated[MotionLibrary, Depends(library)]
