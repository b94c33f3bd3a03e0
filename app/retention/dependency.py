"""The retention of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.dependencies import OneSession
from app.retention.service import Retention


def retention(session: OneSession) -> Retention:
    """The retention in the session of the request."""
    return Retention(session)


Retained = Annotated[Retention, Depends(retention)]
