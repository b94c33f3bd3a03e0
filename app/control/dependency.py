"""The control of rigs of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.control.service import Control
from app.dependencies import OneSession


def control(session: OneSession) -> Control:
    """The control of rigs in the session of the request."""
    return Control(session)


Controlled = Annotated[Control, Depends(control)]
