"""The service of annotations of a request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends

from app.annotations.service import AnnotationService
from app.dependencies import OneSession
from app.runs.dependency import Runs


def annotation_service(session: OneSession, runs: Runs) -> AnnotationService:
    """The service of annotations in the session of the request."""
    return AnnotationService(session, runs)


Annotations = Annotated[AnnotationService, Depends(annotation_service)]
